#include "host/simulation/study/setup.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <string>

#include "host/base/error.hpp"
#include "host/base/text/degrees.hpp"
#include "host/base/text/numbers.hpp"
#include "host/simulation/robot/normal_deviates.hpp"
#include "host/simulation/study/limits.hpp"
#include "host/simulation/study/synthetic_drive.hpp"

namespace astro::simulation::study {
namespace {

// Different from the seeds of the drives, whose indices count from 0.
constexpr std::uint64_t kClocks = 1'000'000;

void demand(bool holds, double value, const std::string& what, const std::string& permitted) {
  if (!holds)
    throw Error(what + " is " + to_text(value) + ": it has to be " + permitted, LimitProblem::out_of_range,
                {what, to_text(value)});
}

// Far more than anybody needs; larger numbers from a damaged file or a typing error would exhaust the memory.
constexpr int kMostTrials = 10'000'000, kMostSquares = 1000, kMostCircles = 1000;
// The maximum likelihood estimate does not accept a larger e as that of tyres.
constexpr double kLargestE = 0.2;
constexpr double kLargestWindup_rad = 0.1;

/// An end heading is known only within half a turn; if the error is larger, no method can use the square.
void require_square(const TrialSetup& setup) {
  double error_rad = 0;
  for (const Sense sense : {Sense::cw, Sense::ccw})
    error_rad = std::max(
        error_rad,
        std::abs(calibration::replay_square(setup.side_m, sense, setup.loaded(), setup.actual()).theta_rad));
  if (error_rad < std::numbers::pi) return;
  throw Error(fmt::format(
      "a square of {:g} m turns a robot with these errors {:.0f} degrees away from its heading, and an end "
      "pose can show at most 180: with these errors the side can be at most some {:.2g} m",
      setup.side_m, degrees(error_rad), setup.side_m * std::numbers::pi / error_rad));
}

/// Driving time of all runs of a trial, without rests.
double driving_time_s(const TrialSetup& setup) {
  const DriveModel usual;
  const double turn_rad = 2 * std::numbers::pi, circle_rad = kCircleTurns * turn_rad;
  const double square_s = 4 * setup.side_m / usual.speed_mps + turn_rad / usual.yaw_rate_radps;
  const double circle_s =
      circle_rad * std::max(setup.circle_radius_m / usual.speed_mps, 1 / usual.yaw_rate_radps);
  return 2 * setup.runs * square_s + 2 * setup.circles * circle_s;
}

/// A seed must be an integer: the library would also convert 1e300, and differently on each machine.
std::uint64_t seed_from(const nlohmann::json& json) {
  const std::string text = json.dump().substr(0, 40);
  if (!json.is_number_integer())
    throw Error("the seed of a study is a whole number, not " + text, SetupProblem::seed_not_whole, {text});
  return json.get<std::uint64_t>();
}

constexpr std::array<std::string_view, 2> kModels = {"kinematic", "simulator"};

}  // namespace

std::string_view name_of(Model model) { return kModels[static_cast<std::size_t>(model)]; }

std::optional<Model> model_named(std::string_view name) {
  for (std::size_t i = 0; i < kModels.size(); ++i)
    if (kModels[i] == name) return static_cast<Model>(i);
  return std::nullopt;
}

calibration::WheelFactors TrialSetup::actual() const {
  return {scale * 2 * E_d / (E_d + 1), scale * 2 / (E_d + 1), scale * E_b * wheelbase_m, e};
}

calibration::MlOptions TrialSetup::ml_options() const {
  calibration::MlOptions options;
  options.clock_known = clock_known;
  if (noise_known) options.noise = noise;
  return options;
}

void TrialSetup::require(Model driven) const {
  if (model != driven)
    throw Error("this is a study of the " + std::string(name_of(model)) + " model, not of the " +
                    std::string(name_of(driven)) + " model: give it its own robot",
                SetupProblem::of_other_model, {std::string(name_of(model)), std::string(name_of(driven))});
}

void TrialSetup::check() const {
  demand(trials >= 1 && trials <= kMostTrials, trials, "the number of trials", "1 to 10 million");
  demand(runs >= 1 && runs <= kMostSquares, runs, "the number of squares in each direction", "1 to 1000");
  require_positive(side_m, "the side of the square in metres");
  require_positive(wheelbase_m, "the wheelbase in metres");
  require_positive(E_d, "the ratio of the wheels");
  require_positive(E_b, "the ratio of the wheelbases");
  require_positive(scale, "the common scale");
  require_positive(noise.K_m, "the wheel slip K in metres");
  require_positive(noise.sigma_xy_m, "the error of the ground truth's position in metres");
  require_positive(noise.sigma_theta_rad, "the error of the ground truth's heading in radians");
  require_positive(count_rate_hz, "the rate of the counts in Hz");
  require_positive(truth_rate_hz, "the rate of the ground truth in Hz");
  demand(std::isfinite(clock_offset_sd_s) && clock_offset_sd_s >= 0, clock_offset_sd_s,
         "the scatter of the clocks in seconds", "0 or more");
  demand(circles >= 0 && circles <= kMostCircles, circles, "the number of circles in each direction",
         "0 to 1000");
  require_positive(circle_radius_m, "the radius of the circles in metres");
  demand(std::abs(e) <= kLargestE, e, "the curvature effect e", "-0.2 to 0.2");
  demand(windup_rad >= 0 && windup_rad <= kLargestWindup_rad, windup_rad, "the wind-up in radians",
         "0 to 0.1");
  require_fits_memory(driving_time_s(*this), truth_rate_hz, count_rate_hz);
  require_square(*this);
}

nlohmann::json to_json(const TrialSetup& setup) {
  return {{"model", name_of(setup.model)},
          {"trials", setup.trials},
          {"seed", setup.seed},
          {"runs", setup.runs},
          {"side_m", setup.side_m},
          {"circles", setup.circles},
          {"circle_radius_m", setup.circle_radius_m},
          {"wheelbase_m", setup.wheelbase_m},
          {"E_d", setup.E_d},
          {"E_b", setup.E_b},
          {"scale", setup.scale},
          {"e", setup.e},
          {"windup_rad", setup.windup_rad},
          {"K_m", setup.noise.K_m},
          {"sigma_xy_m", setup.noise.sigma_xy_m},
          {"sigma_theta_rad", setup.noise.sigma_theta_rad},
          {"count_rate_hz", setup.count_rate_hz},
          {"truth_rate_hz", setup.truth_rate_hz},
          {"clock", setup.clock_known ? "known" : "estimated"},
          {"clock_offset_sd_s", setup.clock_offset_sd_s},
          {"noise", setup.noise_known ? "known" : "estimated"}};
}

TrialSetup setup_from(const nlohmann::json& json) {
  TrialSetup setup;
  const auto name = json.at("model").get<std::string>();
  const std::optional<Model> model = model_named(name);
  if (!model)
    throw Error("'" + name + "' is not a model of a robot: the models are kinematic and simulator",
                SetupProblem::model_unknown, {name});
  setup.model = *model;
  setup.trials = count_in(json.at("trials").dump(), "trials");
  setup.seed = seed_from(json.at("seed"));
  setup.runs = count_in(json.at("runs").dump(), "runs");
  json.at("side_m").get_to(setup.side_m);
  setup.circles = count_in(json.at("circles").dump(), "circles");
  json.at("circle_radius_m").get_to(setup.circle_radius_m);
  json.at("wheelbase_m").get_to(setup.wheelbase_m);
  json.at("E_d").get_to(setup.E_d);
  json.at("E_b").get_to(setup.E_b);
  json.at("scale").get_to(setup.scale);
  json.at("e").get_to(setup.e);
  json.at("windup_rad").get_to(setup.windup_rad);
  json.at("K_m").get_to(setup.noise.K_m);
  json.at("sigma_xy_m").get_to(setup.noise.sigma_xy_m);
  json.at("sigma_theta_rad").get_to(setup.noise.sigma_theta_rad);
  json.at("count_rate_hz").get_to(setup.count_rate_hz);
  json.at("truth_rate_hz").get_to(setup.truth_rate_hz);
  setup.clock_known = json.at("clock").get<std::string>() == "known";
  json.at("clock_offset_sd_s").get_to(setup.clock_offset_sd_s);
  setup.noise_known = json.at("noise").get<std::string>() == "known";
  return setup;
}

Sense sense_of(int run) { return run % 2 == 0 ? Sense::cw : Sense::ccw; }

std::string name_of(const TrialSetup& setup, int run) {
  const bool square = setup.is_square(run);
  const int index = square ? run : run - 2 * setup.runs;
  return (square ? "square " : "circle ") + std::string(astro::name_of(sense_of(run))) + ' ' +
         std::to_string(index / 2 + 1);
}

std::uint64_t seed_of(const TrialSetup& setup, int trial) {
  return derived_seed(setup.seed, static_cast<std::uint64_t>(trial));
}

std::vector<double> clock_offsets_s(const TrialSetup& setup, int trial) {
  std::vector<double> offsets_s(static_cast<std::size_t>(setup.run_count()), 0);
  if (setup.clock_known) return offsets_s;
  std::mt19937_64 clocks(derived_seed(seed_of(setup, trial), kClocks));
  NormalDeviates normal;
  for (double& offset_s : offsets_s) offset_s = setup.clock_offset_sd_s * normal(clocks);
  return offsets_s;
}

}  // namespace astro::simulation::study
