#include "host/experiment/analysis/squares.hpp"

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/base/sense.hpp"
#include "host/experiment/analysis/loaded_parameter.hpp"
#include "host/experiment/files/same_number.hpp"
#include "host/recording/run/end_error.hpp"

namespace astro::experiment {
namespace {

void accept(Squares& squares, const recording::Run& run, bool first) {
  const calibration::WheelFactors loaded = loaded_factors(run.info);
  if (first) {
    squares.loaded = loaded;
    squares.side_m = run.info.size_m;
  }
  if (!same_factors(loaded, squares.loaded))
    throw Error("the squares were driven with different c_R, c_L or b", {Help::calibrate_each_phase});
  if (!same_number(run.info.size_m, squares.side_m))
    throw Error(
        fmt::format("the squares have different sides ({} m and {} m)", squares.side_m, run.info.size_m),
        {Help::separate_sizes});
  const recording::EndError error = recording::end_error(run);
  (run.info.direction == Sense::cw ? squares.cw : squares.ccw)
      .push_back({error.x_m, error.y_m, error.theta_rad});
}

}  // namespace

bool same_factors(const calibration::WheelFactors& a, const calibration::WheelFactors& b) {
  return same_number(a.c_r, b.c_r) && same_number(a.c_l, b.c_l) && same_number(a.b_m, b.b_m);
}

calibration::WheelFactors loaded_factors(const recording::RunInfo& info) {
  return {loaded_parameter(info, "c_R"), loaded_parameter(info, "c_L"), loaded_parameter(info, "b")};
}

calibration::WheelFactors loaded_in_all(const RunSet& set) {
  const calibration::WheelFactors first = loaded_factors(set.runs.front().info);
  for (std::size_t i = 1; i < set.runs.size(); ++i)
    if (!same_factors(loaded_factors(set.runs[i].info), first))
      throw Error(
          fmt::format("the robot had other factors loaded in {} than in {}", set.names[i], set.names.front()),
          {Help::check_each_phase});
  return first;
}

Squares squares_of(std::span<const recording::Run> runs) {
  Squares squares;
  for (const recording::Run& run : runs)
    if (run.info.kind == "square" && run.info.direction)
      accept(squares, run, squares.cw.empty() && squares.ccw.empty());
  if (squares.cw.empty() && squares.ccw.empty())
    throw Error("none of the recordings is a square", {Help::drive_squares});
  return squares;
}

}  // namespace astro::experiment
