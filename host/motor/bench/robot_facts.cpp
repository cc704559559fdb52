#include "host/motor/bench/robot_facts.hpp"

#include <numbers>
#include <string>

namespace astro::motor {

RobotFacts facts_of(const robot::RemoteParameters& robot) {
  RobotFacts facts;
  facts.counts_per_motor_rev = robot.number("counts_per_motor_rev");
  facts.gear_ratio = robot.number("gear_numerator") / robot.number("gear_denominator");
  facts.wheel_diameter_m = robot.number("wheel_diameter");
  const double nominal_m = std::numbers::pi * facts.wheel_diameter_m / facts.counts_per_turn();
  facts.count_m = {nominal_m * robot.number("c_L"), nominal_m * robot.number("c_R")};
  for (const auto side : kSides) {
    const std::string of = std::string("_") + name(side);
    facts.polarities.motor[at(side)] = static_cast<int>(robot.number("motor_polarity" + of));
    facts.polarities.encoder[at(side)] = static_cast<int>(robot.number("encoder_polarity" + of));
    facts.feed_forward[at(side)] = {robot.number("kS" + of), robot.number("kV" + of),
                                    robot.number("kA" + of)};
  }
  facts.kp = robot.number("kp");
  facts.ki = robot.number("ki");
  facts.observer_radps = robot.number("observer_bandwidth");
  facts.motor_voltage_max_V = robot.number("motor_voltage_max");
  facts.speed_limit_mps = robot.number("speed_limit");
  facts.acceleration_limit_mps2 = robot.number("acceleration_limit");
  return facts;
}

}  // namespace astro::motor
