#include "host/experiment/analysis/gyro_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "host/base/text/degrees.hpp"
#include "host/experiment/analysis/json.hpp"
#include "host/experiment/analysis/squares.hpp"
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

bool has_gyro(const RunSet& set) {
  return std::ranges::any_of(
      set.runs, [](const recording::Run& run) { return !run.yaw_rates.empty() || !run.gyro.empty(); });
}

/// The gyro_scale that all runs had.
std::optional<double> loaded_scale(const RunSet& set) {
  std::optional<double> loaded;
  for (const recording::Run& run : set.runs) {
    const auto found = run.info.parameters.find("gyro_scale");
    if (found == run.info.parameters.end()) return std::nullopt;
    if (loaded && *loaded != found->second) return std::nullopt;
    loaded = found->second;
  }
  return loaded;
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
  calibration::GyroDrive drive{name, wheels_of(run, name), {}, {}};
  const std::int64_t origin_us = run.odometry.front().time_us;
  const auto seconds = [&](std::int64_t time_us) { return 1e-6 * static_cast<double>(time_us - origin_us); };
  drive.count_m = nominal_wheel(run.info, name).metres_per_count();
  for (const recording::YawRate& rate : run.yaw_rates)
    drive.rates.push_back({seconds(rate.time_us), rate.rate_radps});
  for (const recording::GyroPose& pose : run.gyro)
    if (std::isfinite(pose.omega_radps)) drive.rates.push_back({seconds(pose.time_us), pose.omega_radps});
  return drive;
}

std::vector<std::vector<calibration::Slip>> slips_by_gyro(const RunSet& set) {
  if (!has_gyro(set)) return {};
  std::vector<calibration::GyroDrive> drives;
  for (std::size_t i = 0; i < set.runs.size(); ++i) drives.push_back(gyro_drive(set.runs[i], set.names[i]));
  std::vector<std::vector<calibration::Slip>> slips(drives.size());
  try {
    const calibration::WheelFactors loaded = loaded_factors(set.runs.front().info, set.names.front());
    for (const calibration::UnseenTurn& turn : calibration::compare_gyro(drives, loaded).slips)
      slips[turn.drive].push_back(turn.slip);
  } catch (const Error& error) {
    using enum calibration::GyroProblem;
    if (error.kind() != no_rates && error.kind() != no_turns && error.kind() != nothing_alike) throw;
  }
  return slips;
}

std::optional<GyroResult> calibrate_gyro(const RunSet& set, const Calibration& found) {
  if (!has_gyro(set)) return std::nullopt;
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
  result.loaded_scale = loaded_scale(set);
  return result;
}

GyroAlone factors_by_gyro(const RunSet& set, double scale_error) {
  std::vector<calibration::GyroDrive> drives;
  for (std::size_t i = 0; i < set.runs.size(); ++i) drives.push_back(gyro_drive(set.runs[i], set.names[i]));
  const calibration::WheelFactors loaded = loaded_factors(set.runs.back().info, set.names.back());
  GyroAlone result{calibration::compare_gyro(drives, loaded), loaded, loaded, 0, 0, set.names};
  const calibration::GyroAgainstWheels& wheels = result.against_wheels;
  const double E_d = loaded.c_r / loaded.c_l * (1 + wheels.difference), sum = loaded.c_r + loaded.c_l;
  result.factors.c_l = sum / (1 + E_d);
  result.factors.c_r = E_d * result.factors.c_l;
  result.factors.b_m = loaded.b_m / std::abs(wheels.product);
  result.E_d_se = wheels.difference_se * E_d;
  result.b_se_m = result.factors.b_m * std::hypot(wheels.product_se / wheels.product, scale_error);
  return result;
}

std::optional<double> GyroResult::parameter() const {
  if (!loaded_scale || scale.scale <= 0) return std::nullopt;
  return *loaded_scale * scale.scale;
}

std::string gyro_sentence(const GyroResult& result) {
  return fmt::format("The gyro measures {:.5f} ± {:.5f} of what the robot turned{}, by {}. {}",
                     std::abs(result.scale.scale), result.scale.se,
                     result.scale.scale < 0 ? ", clockwise instead of counter-clockwise" : "",
                     names_of(result.by).in_words, timing_sentence(result.against_wheels));
}

std::string timing_sentence(const calibration::GyroAgainstWheels& wheels) {
  std::string text =
      fmt::format("It is {:.1f} ± {:.1f} ms {} than the encoders.", 1000 * std::abs(wheels.lag_s),
                  1000 * wheels.lag_se_s, wheels.lag_s < 0 ? "earlier" : "later");
  std::vector<std::string> biases;
  for (const calibration::GyroBias& bias : wheels.biases)
    biases.push_back(fmt::format("{:.3f} ± {:.3f}", degrees(bias.radps), degrees(bias.se_radps)));
  constexpr std::size_t kMostBiases = 12;
  if (biases.size() <= kMostBiases)
    text += fmt::format(" Its bias at the end of {}: {} degrees a second.",
                        biases.size() == 1 ? "the drive" : "each drive", fmt::join(biases, ", "));
  return text;
}

std::vector<std::string> slip_sentences(const calibration::GyroAgainstWheels& wheels,
                                        const std::vector<std::string>& names) {
  std::vector<std::string> sentences;
  for (const calibration::UnseenTurn& unseen : wheels.slips)
    sentences.push_back(fmt::format(
        "{}: by its gyro the robot turned by {:.1f} degrees without its wheels, {:.1f} to {:.1f} s after the "
        "start, at x {:.2f} m, y {:.2f} m of its odometry; these seconds are left out",
        names.at(unseen.drive), degrees(unseen.slip.turn_rad), unseen.slip.begin_s, unseen.slip.end_s,
        unseen.place.x_m, unseen.place.y_m));
  return sentences;
}

std::vector<std::string> notes_of(const GyroResult& result) {
  std::vector<std::string> notes{gyro_sentence(result)};
  for (const std::string& slip : slip_sentences(result.against_wheels, result.names))
    notes.push_back(slip + '.');
  return notes;
}

namespace {

nlohmann::json to_json(const calibration::GyroAgainstWheels& wheels, const std::vector<std::string>& names) {
  nlohmann::json biases = nlohmann::json::array(), slips = nlohmann::json::array();
  for (const calibration::GyroBias& bias : wheels.biases)
    biases.push_back(
        {{"drive", bias.drive}, {"radps", number(bias.radps)}, {"se_radps", number(bias.se_radps)}});
  for (const calibration::UnseenTurn& unseen : wheels.slips)
    slips.push_back({{"drive", names.at(unseen.drive)},
                     {"begin_s", unseen.slip.begin_s},
                     {"end_s", unseen.slip.end_s},
                     {"turn_rad", unseen.slip.turn_rad},
                     {"x_m", unseen.place.x_m},
                     {"y_m", unseen.place.y_m}});
  return {{"lag_s", number(wheels.lag_s)},
          {"lag_se_s", number(wheels.lag_se_s)},
          {"product", number(wheels.product)},
          {"product_se", number(wheels.product_se)},
          {"random_walk_rad", number(std::sqrt(wheels.noise.gyro_rad2ps))},
          {"biases", biases},
          {"slips", slips}};
}

}  // namespace

nlohmann::json to_json(const GyroResult& result) {
  nlohmann::json json = to_json(result.against_wheels, result.names);
  json["scale"] = number(std::abs(result.scale.scale));
  json["scale_se"] = number(result.scale.se);
  json["sign"] = result.scale.scale < 0 ? -1 : 1;
  if (const auto parameter = result.parameter()) json["gyro_scale"] = number(*parameter);
  json["scale_by"] = names_of(result.by).in_json;
  return json;
}

nlohmann::json to_json(const GyroAlone& result) {
  nlohmann::json json = to_json(result.against_wheels, result.names);
  json["E_d"] = number(result.factors.c_r / result.factors.c_l);
  json["E_d_se"] = number(result.E_d_se);
  json["b"] = number(result.factors.b_m);
  json["b_se"] = number(result.b_se_m);
  return json;
}

}  // namespace astro::experiment
