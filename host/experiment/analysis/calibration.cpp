#include "host/experiment/analysis/calibration.hpp"

#include <algorithm>
#include <cmath>

#include "host/base/error.hpp"
#include "host/experiment/files/method_names.hpp"

namespace astro::experiment {
namespace {

using Family = MethodChoice::Family;

calibration::Options options_for(const Squares& squares, const MethodChoice& method) {
  if (method.family == Family::end_poses) return method.options;
  const auto has_heading = [](const calibration::EndPose& pose) { return std::isfinite(pose.theta_rad); };
  const bool headings = std::all_of(squares.cw.begin(), squares.cw.end(), has_heading) &&
                        std::all_of(squares.ccw.begin(), squares.ccw.end(), has_heading);
  calibration::Options options;
  options.method = headings ? calibration::Method::extended : calibration::Method::umbmark;
  return options;
}

bool uses_ml(std::span<const recording::Run> runs, const MethodChoice& method) {
  return method.family == Family::ml ||
         (method.family == Family::automatic &&
          std::all_of(runs.begin(), runs.end(), [](const auto& run) { return has_moving_truth(run.info); }));
}

Calibration by_ml(const RunSet& set, const MlChoice& choice) {
  const std::vector<calibration::Trajectory> runs = trajectories_of(set);
  Calibration result;
  result.carried = last_carried(set);
  MlResult ml;
  ml.options.clock_known = clock_known(set, choice.clock);
  ml.options.noise = choice.noise;
  ml.estimate = calibration::estimate_ml(runs, result.carried, ml.options);
  result.factors = ml.estimate.factors;
  const calibration::MlErrors& se = ml.estimate.se;
  result.se = {
      se.c_r,  se.c_l, se.b_m, se.E_d * result.carried.c_l / result.carried.c_r, se.b_m / result.carried.b_m,
      se.scale};
  result.robot = identity_of(set.runs.front().info);
  result.wheel = nominal_wheel(set.runs.front().info, set.names.front());
  result.squares = summary_of_squares(set.runs);
  result.detail = std::move(ml);
  return result;
}

}  // namespace

bool clock_known(const RunSet& set, MlChoice::Clock clock) {
  if (clock != MlChoice::Clock::automatic) return clock == MlChoice::Clock::known;
  return std::all_of(set.runs.begin(), set.runs.end(),
                     [](const recording::Run& run) { return run.info.truth_clock == "robot"; });
}

// Times are in whole seconds: of equal ones the later in order.
calibration::WheelFactors last_carried(const RunSet& set) {
  const recording::RunInfo* last = &set.runs.front().info;
  for (const recording::Run& run : set.runs)
    if (run.info.started_at >= last->started_at) last = &run.info;
  return carried_factors(*last);
}

std::string_view Calibration::method() const {
  const calibration::Estimate* estimate = end_poses();
  return estimate == nullptr ? kMlName : calibration::name_of(estimate->options.method);
}

double Calibration::E_d() const {
  if (const calibration::Estimate* estimate = end_poses()) return estimate->E_d;
  return factors.c_r / factors.c_l / (carried.c_r / carried.c_l);
}

double Calibration::E_b() const {
  if (const calibration::Estimate* estimate = end_poses()) return estimate->E_b;
  return factors.b_m / carried.b_m;
}

double Calibration::scale_change() const { return 2 * scale() / (carried.c_r + carried.c_l); }

Calibration calibrate(const Squares& squares, const MethodChoice& method) {
  if (method.family == Family::ml)
    throw Error(
        "maximum likelihood needs whole drives with ground truth, and end poses are all there is",
        {Help::use_end_poses});
  const calibration::Estimate estimate = calibration::estimate_factors(
      squares.cw, squares.ccw, squares.side_m, squares.carried, options_for(squares, method));
  Calibration result;
  result.carried = estimate.carried;
  result.factors = estimate.factors;
  result.se = {estimate.se.c_r, estimate.se.c_l, estimate.se.b_m,
               estimate.se.E_d, estimate.se.E_b, FactorErrors::kUnknown};
  result.squares = estimate.summary;
  result.detail = estimate;
  return result;
}

Calibration calibrate(const RunSet& set, const MethodChoice& method, const MlChoice& ml) {
  if (uses_ml(set.runs, method)) return by_ml(set, ml);
  Calibration result = calibrate(squares_of(set.runs), method);
  result.robot = identity_of(set.runs.front().info);
  // Recordings of other origin may do without: the ratios that end poses give need no wheel.
  if (const recording::RunInfo& info = set.runs.front().info; info.parameters.contains("wheel_diameter"))
    result.wheel = nominal_wheel(info, set.names.front());
  return result;
}

Calibration calibrate_after(std::span<const RunSet> phases, const MethodChoice& method) {
  RunSet all;
  for (const RunSet& phase : phases) {
    all.names.insert(all.names.end(), phase.names.begin(), phase.names.end());
    all.runs.insert(all.runs.end(), phase.runs.begin(), phase.runs.end());
  }
  if (!uses_ml(all.runs, method)) return calibrate(phases.back(), method);
  Calibration result = by_ml(all, {});
  result.squares = summary_of_squares(phases.back().runs);
  return result;
}

}  // namespace astro::experiment
