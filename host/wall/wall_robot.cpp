#include "host/wall/wall_robot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/base/error.hpp"

namespace astro::wall {

double BodySize::turning_gap_m() const {
  constexpr double kHand_m = 0.1;
  const double furthest_m = std::max(front_to_axle_m, length_m - front_to_axle_m);
  return std::hypot(furthest_m, width_m / 2) - front_to_axle_m + kHand_m;
}

WallRobot wall_robot_of(const robot::RemoteParameters& robot) {
  WallRobot facts;
  facts.wheel_diameter_m = robot.number("wheel_diameter");
  facts.count_m = std::numbers::pi * facts.wheel_diameter_m * robot.number("gear_denominator") /
                  (robot.number("counts_per_motor_rev") * robot.number("gear_numerator"));
  facts.loaded = {robot.number("c_R"), robot.number("c_L"), robot.number("b")};
  if (robot.find("e") != nullptr) {
    facts.loaded.e = robot.number("e");
    facts.loaded.kappa0 = robot.number("kappa0");
  }
  facts.kS_V = {robot.number("kS_left"), robot.number("kS_right")};
  facts.kV_Vspm = {robot.number("kV_left"), robot.number("kV_right")};
  facts.kA_Vs2pm = {robot.number("kA_left"), robot.number("kA_right")};
  facts.speed_limit_mps = robot.number("speed_limit");
  facts.yaw_rate_limit_radps = robot.number("yaw_rate_limit");
  facts.acceleration_mps2 = robot.number("acceleration_limit");
  facts.yaw_acceleration_radps2 = robot.number("yaw_acceleration_limit");
  facts.uses_gyro = robot.find("gyro_axis") != nullptr && robot.number("gyro_axis") != 0;
  if (facts.uses_gyro) facts.gyro_scale = robot.number("gyro_scale");
  facts.half_voltage_V = robot.number("motor_voltage_max") / 2;
  return facts;
}

double push_voltage_V(const PushLimit& limit, const WallRobot& robot) {
  const double kS_V = std::max(robot.kS_V[0], robot.kS_V[1]);
  const double torque_per_V = limit.stall_Nm / (limit.stall_V - std::min(robot.kS_V[0], robot.kS_V[1]));
  const double force_per_V = 2 * torque_per_V / (robot.wheel_diameter_m / 2);
  if (!(force_per_V > 0))
    throw Error("the stall torque and the stall voltage of a motor have to be positive");
  const double voltage_V = limit.force_N / force_per_V;
  constexpr double kToStart = 2, kBelowStall = 0.8;
  if (voltage_V < kToStart * kS_V)
    throw Error(
        fmt::format(
            "a push of {:g} N is {:.2f} V, on which the wheels would not start turning; {:.0f} N would do",
            limit.force_N, voltage_V, std::ceil(kToStart * kS_V * force_per_V)),
        WallProblem::push_too_weak, {fmt::format("{:g}", limit.force_N)});
  if (voltage_V > kBelowStall * robot.half_voltage_V)
    throw Error(
        fmt::format("a push of {:g} N is {:.1f} V, which the robot would take for a stall; up to {:.0f} N is "
                    "possible",
                    limit.force_N, voltage_V, std::floor(kBelowStall * robot.half_voltage_V * force_per_V)),
        WallProblem::push_too_strong, {fmt::format("{:g}", limit.force_N)});
  return voltage_V;
}

}  // namespace astro::wall
