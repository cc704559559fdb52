#include "host/motor/model/roll.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "host/base/error.hpp"
#include "host/base/text/numbers.hpp"

namespace astro::motor {
namespace {

constexpr double kSame = 0.03, kAlike = 0.05;
constexpr double kMostOff =
    5;  // largest plausible error of an entered gear or wheel; beyond it, the length was wrong

double turns_of(const Roll& roll) {
  return roll.turns ? *roll.turns : *roll.distance_m / (std::numbers::pi * roll.wheel_diameter_m);
}

// 2, 4, 8 or one of their inverses; 1 if it is none of them.
double decoding_factor(double ratio) {
  const double power = std::round(std::log2(ratio));
  if (power == 0 || std::abs(power) > 3) return 1;
  const double factor = std::exp2(power);
  return std::abs(ratio / factor - 1) <= kAlike ? factor : 1;
}

std::string in_percent(double ratio) {
  return fmt::format("{:+.1f} %", without_minus_zero(100 * (ratio - 1), 1));
}

void propose(const Roll& roll, double ratio, RollVerdict& verdict) {
  const double factor = decoding_factor(ratio), counts = roll.counts_per_motor_rev * factor;
  if (factor == 1 && (ratio > kMostOff || ratio < 1 / kMostOff))
    throw Error(fmt::format("the wheels counted {:.3g} times what the parameters say for {}, which neither a "
                            "gear nor a wheel explains: roll again, and check the length",
                            ratio,
                            roll.turns ? fmt::format("{:g} wheel turns", *roll.turns)
                                       : fmt::format("{:g} m", *roll.distance_m)),
                RollProblem::unlikely_length);
  if (factor != 1 && counts == std::round(counts)) {
    verdict.parameters["counts_per_motor_rev"] = counts;
    verdict.finding = {
        fmt::format(
            "the wheels count {:.3g} times what they should: counts_per_motor_rev is {:.0f}, not {:.0f}",
            ratio, counts, roll.counts_per_motor_rev),
        RollProblem::other_decoding};
  } else if (roll.turns) {
    const double gear = roll.gear_ratio * ratio;
    const std::string found = fmt::format("{:.3f}", gear), loaded = fmt::format("{:.3f}", roll.gear_ratio);
    verdict.parameters["gear_numerator"] = std::round(gear * 1000);
    verdict.parameters["gear_denominator"] = 1000;
    verdict.finding = {
        fmt::format("the wheels count {} against the parameters: with {:.0f} counts a motor turn the gear "
                    "ratio is {}, not {}",
                    in_percent(ratio), roll.counts_per_motor_rev, found, loaded),
        RollProblem::other_gear,
        {found, loaded}};
  } else {
    const double diameter_m = roll.wheel_diameter_m / ratio;
    verdict.parameters["wheel_diameter"] = diameter_m;
    verdict.finding = {
        fmt::format("the wheels count {} against the parameters: the wheel diameter would be {:.1f} mm, not "
                    "{:.1f} mm; if it is not, roll again and count turns (gear ratio)",
                    in_percent(ratio), 1e3 * diameter_m, 1e3 * roll.wheel_diameter_m),
        RollProblem::other_diameter};
  }
}

}  // namespace

RollVerdict judge_roll(const Roll& roll) {
  const double turn_counts = roll.counts_per_motor_rev * roll.gear_ratio, turns = turns_of(roll);
  if (!(turns >= 0.5))
    throw Error("less than half a wheel turn does not show how the wheels count: roll the robot ten turns",
                RollProblem::too_short);
  RollVerdict verdict;
  for (std::size_t side = 0; side < 2; ++side)
    verdict.ratio[side] = std::abs(roll.counts[side]) / (turns * turn_counts);
  const auto [left, right] = verdict.ratio;
  if (left < 0.02 || right < 0.02) {
    const std::string side = left < right ? "left" : "right";
    throw Error("the " + side +
                    " wheel counted next to nothing: roll the robot straight on, and check the wiring first",
                RollProblem::counts_nothing, {side});
  }
  const double mean = std::sqrt(left * right);
  if (std::abs(left / right - 1) > kAlike) {
    const std::string of_left = fmt::format("{:.3g}", left), of_right = fmt::format("{:.3g}", right);
    verdict.finding = {"the left wheel counts " + of_left + " and the right one " + of_right +
                           " times what they should: roll straight on, and look whether both encoders are "
                           "of one kind",
                       RollProblem::wheels_differ,
                       {of_left, of_right}};
  } else if (std::abs(mean - 1) <= kSame) {
    verdict.agrees = true;
    verdict.finding.sentence =
        fmt::format("counts per revolution are right: {} over {:.1f} turns", in_percent(mean), turns);
  } else {
    propose(roll, mean, verdict);
  }
  return verdict;
}

}  // namespace astro::motor
