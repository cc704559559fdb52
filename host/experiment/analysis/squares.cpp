#include "host/experiment/analysis/squares.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/base/error.hpp"
#include "host/base/pose2.hpp"
#include "host/base/text/sense.hpp"
#include "host/experiment/analysis/analysis_problem.hpp"
#include "host/experiment/analysis/loaded_parameter.hpp"
#include "host/experiment/analysis/trajectories.hpp"
#include "host/experiment/files/curvature_named.hpp"
#include "host/experiment/files/same_number.hpp"
#include "host/recording/end_error.hpp"
#include "host/recording/run_metadata.hpp"

namespace astro::experiment {
namespace {

using calibration::EndPose;
using calibration::SquareEnd;

SquareEnd end_in(const recording::Run& run, const std::string& file = "") {
  const auto [absolute, odometry] = recording::ends_of(run, file);
  return {wrapped(absolute), wrapped(odometry)};
}

/// The squares of one direction, before any is left out.
struct Driven {
  std::vector<SquareEnd> ends;
  std::vector<std::string> names, from;
  std::vector<bool> entered;  // by a person
};

struct AllDriven {
  Driven cw, ccw;

  Driven& of(Sense sense) { return sense == Sense::cw ? cw : ccw; }
};

void accept(Squares& squares, AllDriven& driven, const recording::Run& run, const std::string& file) {
  const calibration::WheelFactors loaded = loaded_factors(run.info, file);
  const bool first = driven.cw.ends.empty() && driven.ccw.ends.empty();
  if (first) {
    squares.loaded = loaded;
    squares.side_m = run.info.size_m;
  }
  if (!same_factors(loaded, squares.loaded))
    throw Error(
        "the squares were driven with different c_R, c_L or b, or another e: calibrate each phase for itself "
        "(name its folder)",
        AnalysisProblem::squares_of_different_factors);
  if (!same_number(run.info.size_m, squares.side_m))
    throw Error(
        fmt::format("the squares have different sides ({} m and {} m): keep each size in a folder of its own",
                    squares.side_m, run.info.size_m),
        AnalysisProblem::squares_of_different_sizes,
        {fmt::format("{}", squares.side_m), fmt::format("{}", run.info.size_m)});
  Driven& direction = driven.of(*run.info.direction);
  direction.ends.push_back(end_in(run, file));
  direction.names.push_back(recording::run_name(run.info));
  direction.from.push_back(file.empty() ? direction.names.back() : "'" + file + "'");
  direction.entered.push_back(!run.info.truth_source.empty() && !has_moving_truth(run.info));
}

/// Which squares of a direction are used.
std::vector<bool> sifted(Squares& squares, const Driven& direction, Sense sense,
                         std::span<const calibration::OddRun> odd_runs) {
  constexpr std::ptrdiff_t kFewest = 3;
  std::vector<bool> used(direction.ends.size(), true);
  for (const calibration::OddRun& odd : odd_runs) {
    if (odd.sense != sense || !direction.entered[odd.index]) continue;
    if (std::ranges::count(used, true) <= kFewest) break;
    used[odd.index] = false;
    squares.left_out.push_back(direction.names[odd.index] + " is left out: " + described(odd));
  }
  return used;
}

void take(Squares& squares, const Driven& direction, Sense sense,
          std::span<const calibration::OddRun> odd_runs) {
  const std::vector<bool> used = sifted(squares, direction, sense, odd_runs);
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) continue;
    (sense == Sense::cw ? squares.cw : squares.ccw).push_back(direction.ends[i].error());
    (sense == Sense::cw ? squares.cw_from : squares.ccw_from).push_back(direction.from[i]);
  }
}

}  // namespace

bool same_factors(const calibration::WheelFactors& a, const calibration::WheelFactors& b) {
  const bool same_arcs = same_number(a.e, b.e) && (same_number(a.e, 0) || same_number(a.kappa0, b.kappa0));
  return same_number(a.c_r, b.c_r) && same_number(a.c_l, b.c_l) && same_number(a.b_m, b.b_m) && same_arcs;
}

calibration::WheelFactors loaded_factors(const recording::RunInfo& info, const std::string& file) {
  return with_curvature_named(
      {loaded_parameter(info, "c_R", file), loaded_parameter(info, "c_L", file),
       loaded_parameter(info, "b", file)},
      info.parameters, fmt::format("the recording '{}'", file.empty() ? recording::run_name(info) : file));
}

calibration::WheelFactors loaded_in_all(const RunSet& set) {
  const calibration::WheelFactors first = loaded_factors(set.runs.front().info);
  for (std::size_t i = 1; i < set.runs.size(); ++i)
    if (!same_factors(loaded_factors(set.runs[i].info), first))
      throw Error(fmt::format("the robot had other factors loaded in {} than in {}: check them separately",
                              set.names[i], set.names.front()),
                  AnalysisProblem::runs_of_different_factors, {set.names[i], set.names.front()});
  return first;
}

Squares squares_of(std::span<const recording::Run> runs, std::span<const std::string> files) {
  Squares squares;
  AllDriven driven;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::string file = files.empty() ? "" : files[i];
    if (runs[i].info.kind == "square" && runs[i].info.direction) accept(squares, driven, runs[i], file);
    if (const auto line = line_of(runs[i], file)) squares.lines.push_back(*line);
  }
  if (driven.cw.ends.empty() && driven.ccw.ends.empty())
    throw Error("none of the recordings is a square", AnalysisProblem::no_squares);
  const auto odd = calibration::odd_runs(driven.cw.ends, driven.ccw.ends, {squares.side_m, squares.loaded});
  take(squares, driven.cw, Sense::cw, odd);
  take(squares, driven.ccw, Sense::ccw, odd);
  return squares;
}

std::optional<calibration::LineEnd> line_of(const recording::Run& run, const std::string& file) {
  if (run.info.kind != "line") return std::nullopt;
  const SquareEnd end = square_end(run);
  const Twist2 arc = end.odometry.log();
  if (!(end.odometry.x_m > 0) || !std::isfinite(end.measured.x_m)) return std::nullopt;
  const calibration::WheelFactors loaded = loaded_factors(run.info, file);
  return calibration::LineEnd{end.measured.x_m, end.measured.y_m, std::hypot(arc.x_m, arc.y_m),
                              (loaded.c_r + loaded.c_l) / 2};
}

SquareEnd square_end(const recording::Run& run) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  try {
    return end_in(run);
  } catch (const Error&) {
    return {{kUnknown, kUnknown, kUnknown}};
  }
}

}  // namespace astro::experiment
