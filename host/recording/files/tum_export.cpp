#include "host/recording/files/tum_export.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "host/base/files.hpp"
#include "host/base/numbers.hpp"

namespace astro::recording {
namespace {

void append_pose(std::string& text, std::int64_t time_us, double x_m, double y_m, double theta_rad) {
  const double half = std::isfinite(theta_rad) ? theta_rad / 2 : 0;
  text += seconds_text(time_us) + ' ' + to_text(x_m) + ' ' + to_text(y_m) + " 0 0 0 " +
          to_text(std::sin(half)) + ' ' + to_text(std::cos(half)) + '\n';
}

template <class Sample>
void write(const std::filesystem::path& path, const std::vector<Sample>& samples, const auto& is_valid) {
  constexpr std::size_t kWrittenAtATime = 65536;
  std::string text = "# timestamp tx ty tz qx qy qz qw\n";
  require_own_kind(path, text, "export");
  PartFile file(path);
  for (const Sample& sample : samples) {
    if (!is_valid(sample)) continue;
    append_pose(text, sample.time_us, sample.x_m, sample.y_m, sample.theta_rad);
    if (text.size() < kWrittenAtATime) continue;
    file.write(as_bytes(text));
    text.clear();
  }
  file.write(as_bytes(text));
  file.commit();
}

}  // namespace

void export_tum(const Run& run, const std::filesystem::path& folder) {
  write(folder / "odometry.tum", run.odometry, [](const OdometrySample&) { return true; });
  write(folder / "truth.tum", run.truth, [](const TruthSample& sample) { return sample.valid; });
}

}  // namespace astro::recording
