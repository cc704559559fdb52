#include "host/experiment/drive/mistyped_square.hpp"

#include <limits>
#include <vector>

#include "host/base/error.hpp"
#include "host/calibration/end_poses/odd_run.hpp"
#include "host/recording/run/end_error.hpp"

namespace astro::experiment {

RunEnd run_end(const RunSpec& spec, const recording::Run& run) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  try {
    const recording::EndError error = recording::end_error(run);
    return {spec, {error.x_m, error.y_m, error.theta_rad}};
  } catch (const Error&) {
    return {spec, {kUnknown, kUnknown, kUnknown}};
  }
}

std::optional<MistypedSquare> mistyped_square(std::span<const RunEnd> ends, double side_m) {
  const RunSpec& last = ends.back().spec;
  if (last.kind != "square") return std::nullopt;
  std::vector<RunSpec> specs;
  std::vector<calibration::EndPose> errors;
  for (const RunEnd& end : ends) {
    if (end.spec.phase != last.phase || end.spec.kind != last.kind || end.spec.direction != last.direction)
      continue;
    specs.push_back(end.spec);
    errors.push_back(end.error);
  }
  const auto odd = calibration::mistyped_run(errors, side_m);
  if (!odd) return std::nullopt;
  return MistypedSquare{specs[odd->index].title() + ": " + described(*odd), specs[odd->index]};
}

}  // namespace astro::experiment
