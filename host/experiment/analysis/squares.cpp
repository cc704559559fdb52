#include "host/experiment/analysis/squares.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/base/error.hpp"
#include "host/experiment/files/number_named.hpp"
#include "host/experiment/files/plan.hpp"
#include "host/experiment/files/same_number.hpp"
#include "host/recording/run/end_error.hpp"

namespace astro::experiment {
namespace {

using recording::Direction;

double parameter(const recording::RunInfo& info, const char* name) {
  const std::optional<double> value = number_named(info.parameters, name);
  if (!value)
    throw Error(fmt::format(
        "the recording of {} {} {} does not say which {} was loaded in the robot: it cannot be calibrated",
        info.kind, name_of(info.direction), info.index, name));
  return *value;
}

void accept(Squares& squares, const recording::Run& run, bool first) {
  const calibration::WheelFactors loaded = loaded_factors(run.info);
  if (first) {
    squares.loaded = loaded;
    squares.side_m = run.info.size_m;
  }
  if (!same_factors(loaded, squares.loaded))
    throw Error("the squares were driven with different c_R, c_L or b", {Help::calibrate_each_phase});
  if (std::abs(run.info.size_m - squares.side_m) > 1e-9)
    throw Error(
        fmt::format("the squares have different sides ({} m and {} m)", squares.side_m, run.info.size_m),
        {Help::separate_sizes});
  const recording::EndError error = recording::end_error(run);
  (run.info.direction == Direction::cw ? squares.cw : squares.ccw)
      .push_back({error.x_m, error.y_m, error.theta_rad});
}

}  // namespace

bool same_factors(const calibration::WheelFactors& a, const calibration::WheelFactors& b) {
  return same_number(a.c_r, b.c_r) && same_number(a.c_l, b.c_l) && same_number(a.b_m, b.b_m);
}

calibration::WheelFactors loaded_factors(const recording::RunInfo& info) {
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

}  // namespace astro::experiment
