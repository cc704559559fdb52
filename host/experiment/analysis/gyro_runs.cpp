#include "host/experiment/analysis/gyro_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "host/base/text/degrees.hpp"
#include "host/experiment/analysis/json.hpp"
#include "host/experiment/analysis/trajectories.hpp"

namespace astro::experiment {
namespace {

/// The headings of a run that a tracker followed, on the robot's clock.
std::vector<calibration::BodySample> headings(std::vector<calibration::BodySample> truth,
                                              const calibration::Trajectory& run, const MlResult& ml) {
  const auto fit = std::ranges::find(ml.estimate.runs, run.name, &calibration::RunFit::name);
  if (fit == ml.estimate.runs.end() || run.ends_only) return {};
  const double skew = ml.estimate.sessions.at(static_cast<std::size_t>(fit->session)).clock_skew,
               middle_s = (run.wheels.front().time_s + run.wheels.back().time_s) / 2 - fit->clock_offset_s;
  for (calibration::BodySample& body : truth)
    body.time_s += fit->clock_offset_s + skew * (body.time_s - middle_s);
  return truth;
}

struct ReferenceNames {
  const char *in_json, *in_words;
};
ReferenceNames names_of(GyroReference by) {
  switch (by) {
    case GyroReference::truth:
      return {"truth", "the headings of the ground truth"};
    case GyroReference::wall:
      return {"wall", "whole turns between two squarings against the wall"};
    default:
      return {"wheels", "the wheels with the factors found"};
  }
}

/// The relative error of the wheelbase over the scale of both wheels, which is that of the wheels' turns.
double turn_error(const Calibration& found) {
  const calibration::FactorCovariance& covariance =
      found.ml() != nullptr ? found.ml()->estimate.covariance : found.scans()->covariance;
  return calibration::errors_of(covariance, found.factors).b_over_scale_m * found.scale() / found.factors.b_m;
}

}  // namespace

calibration::GyroDrive gyro_drive(const recording::Run& run, const std::string& name) {
  recording::Run of_wheels{run.info, run.odometry, {}};
  of_wheels.info.truth_source = "gyro";
  of_wheels.info.truth_clock = "robot";
  const std::int64_t origin_us = run.odometry.empty() ? 0 : run.odometry.front().time_us;
  const auto seconds = [&](std::int64_t time_us) { return 1e-6 * static_cast<double>(time_us - origin_us); };
  calibration::GyroDrive drive{name, trajectory_of(of_wheels, name).wheels, {}, {}};
  drive.count_m = nominal_wheel(run.info, name).metres_per_count();
  for (const recording::YawRate& rate : run.yaw_rates)
    drive.rates.push_back({seconds(rate.time_us), rate.rate_radps});
  for (const recording::GyroPose& pose : run.gyro)
    drive.rates.push_back({seconds(pose.time_us), pose.omega_radps});
  for (const recording::GyroSlip& slip : run.slips)
    drive.reported.push_back({seconds(slip.time_us), slip.turn_rad});
  return drive;
}

std::optional<GyroResult> calibrate_gyro(const RunSet& set, const Calibration& found) {
  if (std::ranges::all_of(
          set.runs, [](const recording::Run& run) { return run.yaw_rates.empty() && run.gyro.empty(); }))
    return std::nullopt;
  std::vector<calibration::GyroDrive> drives;
  for (std::size_t i = 0; i < set.runs.size(); ++i) {
    drives.push_back(gyro_drive(set.runs[i], set.names[i]));
    if (found.ml() == nullptr) continue;
    const calibration::Trajectory trajectory = trajectory_of(set.runs[i], set.names[i]);
    drives.back().truth = headings(trajectory.truth, trajectory, *found.ml());
  }
  GyroResult result{calibration::compare_gyro(drives, found.factors), {}, GyroReference::wheels, set.names};
  const calibration::GyroAgainstWheels& wheels = result.against_wheels;
  const auto by_truth = calibration::gyro_scale_by_truth(drives, found.factors, wheels);
  if (by_truth) result.by = GyroReference::truth;
  result.scale = by_truth.value_or(calibration::GyroScale{
      wheels.product, std::hypot(wheels.product_se, wheels.product * turn_error(found)), wheels.chi_square,
      wheels.degrees_of_freedom});
  return result;
}

std::string gyro_sentence(const GyroResult& result) {
  const calibration::GyroAgainstWheels& wheels = result.against_wheels;
  std::string text = fmt::format(
      "The gyro measures {:.5f} ± {:.5f} of what the robot turns{}, by {}, and is {:.1f} ± {:.1f} ms later "
      "than the "
      "encoders.",
      std::abs(result.scale.scale), result.scale.se,
      result.scale.scale < 0 ? ", clockwise instead of counter-clockwise" : "", names_of(result.by).in_words,
      1000 * wheels.lag_s, 1000 * wheels.lag_se_s);
  std::vector<std::string> biases;
  for (const calibration::GyroBias& bias : wheels.biases)
    biases.push_back(fmt::format("{:.3f} ± {:.3f}", degrees(bias.radps), degrees(bias.se_radps)));
  constexpr std::size_t kMostBiases = 12;
  if (biases.size() <= kMostBiases)
    text += fmt::format(" Its bias at the end of {}: {} degrees a second.",
                        biases.size() == 1 ? "the drive" : "each drive", fmt::join(biases, ", "));
  return text;
}

std::vector<std::string> slip_sentences(const GyroResult& result) {
  std::vector<std::string> sentences;
  for (const calibration::UnseenTurn& slip : result.against_wheels.slips)
    sentences.push_back(
        fmt::format("{}: by its gyro the robot turned by {:.1f} degrees without its wheels, {:.1f} to {:.1f} "
                    "s after the start, at "
                    "x {:.2f} m, y {:.2f} m of its odometry",
                    result.names.at(slip.drive), degrees(slip.turn_rad), slip.begin_s, slip.end_s,
                    slip.place.x_m, slip.place.y_m));
  return sentences;
}

nlohmann::json to_json(const GyroResult& result) {
  const calibration::GyroAgainstWheels& wheels = result.against_wheels;
  nlohmann::json biases = nlohmann::json::array(), slips = nlohmann::json::array();
  for (const calibration::GyroBias& bias : wheels.biases)
    biases.push_back(
        {{"drive", bias.drive}, {"radps", number(bias.radps)}, {"se_radps", number(bias.se_radps)}});
  for (const calibration::UnseenTurn& slip : wheels.slips)
    slips.push_back({{"drive", result.names.at(slip.drive)},
                     {"begin_s", slip.begin_s},
                     {"end_s", slip.end_s},
                     {"turn_rad", slip.turn_rad},
                     {"x_m", slip.place.x_m},
                     {"y_m", slip.place.y_m}});
  return {{"scale", number(std::abs(result.scale.scale))},
          {"scale_se", number(result.scale.se)},
          {"sign", result.scale.scale < 0 ? -1 : 1},
          {"scale_by", names_of(result.by).in_json},
          {"lag_s", number(wheels.lag_s)},
          {"lag_se_s", number(wheels.lag_se_s)},
          {"product", number(wheels.product)},
          {"product_se", number(wheels.product_se)},
          {"random_walk_rad", number(std::sqrt(wheels.noise.gyro_rad2ps))},
          {"biases", biases},
          {"slips", slips}};
}

}  // namespace astro::experiment
