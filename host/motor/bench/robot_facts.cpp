#include "host/motor/bench/robot_facts.hpp"

#include <numbers>
#include <string>

namespace astro::motor {

using motor::kSides;

RobotFacts facts_of(const robot::RemoteParameters& robot) {
  const auto number = [&](const std::string& name) { return std::get<double>(robot.value(name)); };
  RobotFacts facts;
  facts.counts_per_motor_rev = number("counts_per_motor_rev");
  facts.gear_ratio = number("gear_numerator") / number("gear_denominator");
  facts.wheel_diameter_m = number("wheel_diameter");
  const double nominal_m = std::numbers::pi * facts.wheel_diameter_m / facts.counts_per_turn();
  facts.count_m = {nominal_m * number("c_L"), nominal_m * number("c_R")};
  for (const auto side : kSides) {
    const std::string of = std::string("_") + name(side);
    facts.polarities.motor[at(side)] = static_cast<int>(number("motor_polarity" + of));
    facts.polarities.encoder[at(side)] = static_cast<int>(number("encoder_polarity" + of));
    facts.feed_forward[at(side)] = {number("kS" + of), number("kV" + of), number("kA" + of)};
  }
  facts.kp = number("kp");
  facts.ki = number("ki");
  facts.observer_radps = number("observer_bandwidth");
  facts.motor_voltage_max_V = number("motor_voltage_max");
  facts.speed_limit_mps = number("speed_limit");
  facts.acceleration_limit_mps2 = number("acceleration_limit");
  return facts;
}

}  // namespace astro::motor
