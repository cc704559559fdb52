#include "host/experiment/drive/mistyped_square.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "host/base/error.hpp"
#include "host/calibration/end_poses/odd_run.hpp"
#include "host/experiment/files/experiment_folder.hpp"
#include "host/recording/files/run_file.hpp"
#include "host/recording/run/end_error.hpp"

namespace astro::experiment {
namespace {

namespace fs = std::filesystem;

/// The end error of a run; NaN if it cannot be computed. Then the calibration reports why.
calibration::EndPose end_of(const recording::Run& run) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  try {
    const recording::EndError error = recording::end_error(run);
    return {error.x_m, error.y_m, error.theta_rad};
  } catch (const Error&) {
    return {kUnknown, kUnknown, kUnknown};
  }
}

}  // namespace

std::optional<MistypedSquare> mistyped_square(const fs::path& folder, const Plan& plan, const RunSpec& spec,
                                              const recording::Run& run) {
  if (spec.kind != "square") return std::nullopt;
  std::vector<fs::path> files;
  std::vector<std::string> titles;
  std::vector<calibration::EndPose> ends;
  for (int index = 1; index < spec.index; ++index) {
    const RunSpec earlier{spec.phase, spec.kind, spec.direction, index};
    const fs::path file = file_of(folder, earlier);
    if (!fs::exists(file)) continue;
    files.push_back(file);
    titles.push_back(earlier.title());
    ends.push_back(end_of(recording::read_run(file)));
  }
  files.emplace_back();
  titles.push_back(spec.title());
  ends.push_back(end_of(run));
  const auto odd = calibration::mistyped_run(ends, plan.side_m);
  if (!odd) return std::nullopt;
  return MistypedSquare{titles[odd->index] + ": " + described(*odd), files[odd->index]};
}

}  // namespace astro::experiment
