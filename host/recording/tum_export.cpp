#include "host/recording/tum_export.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "host/base/files.hpp"
#include "host/base/text/numbers.hpp"

namespace astro::recording {
namespace {

template <class Sample>
void append(std::string& text, const Sample& sample) {
  const double half = sample.theta_rad / 2;
  text += seconds_text(sample.time_us) + ' ' + to_text(sample.x_m) + ' ' + to_text(sample.y_m) + " 0 0 0 " +
          to_text(std::sin(half)) + ' ' + to_text(std::cos(half)) + '\n';
}

template <class Sample>
void write(const std::filesystem::path& path, const std::vector<Sample>& samples, const auto& is_valid) {
  constexpr std::size_t kWrittenAtATime = 65536;
  std::string text = "# timestamp tx ty tz qx qy qz qw\n";
  require_own_kind(path, text, "export");
  PartFile file(path);
  std::size_t without_heading = 0;
  for (const Sample& sample : samples) {
    if (!is_valid(sample)) continue;
    if (!std::isfinite(sample.theta_rad)) {
      ++without_heading;
      continue;
    }
    append(text, sample);
    if (text.size() < kWrittenAtATime) continue;
    file.write(as_bytes(text));
    text.clear();
  }
  if (without_heading > 0)
    text += "# left out because their heading was not measured: " + std::to_string(without_heading) + "\n";
  file.write(as_bytes(text));
  file.commit();
}

}  // namespace

void export_tum(const Run& run, const std::filesystem::path& folder) {
  write(folder / "odometry.tum", run.odometry, [](const OdometrySample&) { return true; });
  write(folder / "truth.tum", run.truth, [](const TruthSample& sample) { return sample.valid; });
}

}  // namespace astro::recording
