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
#include "host/simulation/study/limits.hpp"
#include "host/simulation/study/synthetic_drive.hpp"

namespace astro::simulation::study {
namespace {

// Different from the seeds of the drives, which count from 0.
constexpr std::uint64_t kClocks = 1'000'000;

void demand(bool holds, double value, const std::string& what, const std::string& permitted) {
  if (!holds) throw Error(what + " is " + to_text(value) + ": it has to be " + permitted);
}

// Far more than anybody needs; larger numbers from a damaged file or a typing error would exhaust the memory.
constexpr int kMostTrials = 10'000'000, kMostSquares = 1000;

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

/// A seed must be an integer: the library would also convert 1e300, and differently on each machine.
std::uint64_t seed_from(const nlohmann::json& json) {
  if (!json.is_number_integer())
    throw Error("the seed of a study is a whole number, not " + json.dump().substr(0, 40));
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
  return {scale * 2 * E_d / (E_d + 1), scale * 2 / (E_d + 1), scale * E_b * wheelbase_m};
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
                    std::string(name_of(driven)) + " model",
                {Help::use_own_robot});
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
  const DriveModel usual;
  require_fits_memory(2 * runs * (4 * side_m / usual.speed_mps + 2 * std::numbers::pi / usual.yaw_rate_radps),
                      truth_rate_hz, count_rate_hz);
  require_square(*this);
}

nlohmann::json to_json(const TrialSetup& setup) {
  return {{"model", name_of(setup.model)},
          {"trials", setup.trials},
          {"seed", setup.seed},
          {"runs", setup.runs},
          {"side_m", setup.side_m},
          {"wheelbase_m", setup.wheelbase_m},
          {"E_d", setup.E_d},
          {"E_b", setup.E_b},
          {"scale", setup.scale},
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
  if (!model) throw Error("'" + name + "' is not a model of a robot: the models are kinematic and simulator");
  setup.model = *model;
  setup.trials = count_in(json.at("trials").dump(), "trials");
  setup.seed = seed_from(json.at("seed"));
  setup.runs = count_in(json.at("runs").dump(), "runs");
  json.at("side_m").get_to(setup.side_m);
  json.at("wheelbase_m").get_to(setup.wheelbase_m);
  json.at("E_d").get_to(setup.E_d);
  json.at("E_b").get_to(setup.E_b);
  json.at("scale").get_to(setup.scale);
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

std::string name_of(int run) {
  return "square " + std::string(astro::name_of(sense_of(run))) + ' ' + std::to_string(run / 2 + 1);
}

std::uint64_t seed_of(const TrialSetup& setup, int trial) {
  return derived_seed(setup.seed, static_cast<std::uint64_t>(trial));
}

std::vector<double> clock_offsets_s(const TrialSetup& setup, int trial) {
  std::vector<double> offsets_s(static_cast<std::size_t>(2 * setup.runs), 0);
  if (setup.clock_known) return offsets_s;
  std::mt19937_64 clocks(derived_seed(seed_of(setup, trial), kClocks));
  std::normal_distribution<double> normal(0, setup.clock_offset_sd_s);
  for (double& offset_s : offsets_s) offset_s = normal(clocks);
  return offsets_s;
}

}  // namespace astro::simulation::study
