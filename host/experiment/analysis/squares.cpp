#include "host/experiment/analysis/squares.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/base/error.hpp"
#include "host/experiment/files/plan.hpp"
#include "host/recording/run/end_error.hpp"

namespace astro::experiment {
namespace {

using recording::Direction;

double parameter(const recording::RunInfo& info, const char* name) {
  const auto found = info.parameters.find(name);
  if (found == info.parameters.end())
    throw Error(fmt::format(
        "the recording of {} {} {} does not say what {} the robot carried: it cannot be calibrated",
        info.kind, name_of(info.direction), info.index, name));
  return found->second;
}

void accept(Squares& squares, const recording::Run& run, bool first) {
  const calibration::WheelFactors carried = carried_factors(run.info);
  if (first) {
    squares.carried = carried;
    squares.side_m = run.info.size_m;
  }
  if (!same_factors(carried, squares.carried))
    throw Error(
        "the squares were driven with different c_R, c_L or b: calibrate each phase for itself (name its "
        "folder)");
  if (std::abs(run.info.size_m - squares.side_m) > 1e-9)
    throw Error(
        fmt::format("the squares have different sides ({} m and {} m): keep each size in a folder of its own",
                    squares.side_m, run.info.size_m));
  const recording::EndError error = recording::end_error(run);
  (run.info.direction == Direction::cw ? squares.cw : squares.ccw)
      .push_back({error.x_m, error.y_m, error.theta_rad});
}

}  // namespace

bool same_factors(const calibration::WheelFactors& a, const calibration::WheelFactors& b) {
  // Half a step of the wire format is far below this, a calibration far above.
  constexpr double kSame = 1e-8;
  return std::abs(a.c_r - b.c_r) < kSame && std::abs(a.c_l - b.c_l) < kSame &&
         std::abs(a.b_m - b.b_m) < kSame;
}

calibration::WheelFactors carried_factors(const recording::RunInfo& info) {
  return {parameter(info, "c_R"), parameter(info, "c_L"), parameter(info, "b")};
}

Squares squares_of(std::span<const recording::Run> runs) {
  Squares squares;
  for (const recording::Run& run : runs)
    if (run.info.kind == "square" && run.info.direction != Direction::none)
      accept(squares, run, squares.cw.empty() && squares.ccw.empty());
  if (squares.cw.empty() && squares.ccw.empty())
    throw Error("none of the recordings is a square", {Help::drive_squares});
  return squares;
}

std::optional<calibration::ExperimentSummary> summary_of_squares(std::span<const recording::Run> runs) {
  try {
    const Squares squares = squares_of(runs);
    if (!squares.cw.empty() && !squares.ccw.empty()) return calibration::summarize(squares.cw, squares.ccw);
  } catch (const Error&) {
  }
  return std::nullopt;
}

}  // namespace astro::experiment
