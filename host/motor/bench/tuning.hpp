#pragma once

#include <map>
#include <optional>
#include <string>

#include "host/motor/bench/identify.hpp"
#include "host/motor/bench/robot_facts.hpp"
#include "host/motor/model/design.hpp"

/// From identified motors to the feed-forward and the gains that a robot should carry. Values in, values out.
namespace astro::motor {

/// The control parameters of a robot by name, in the robot's units.
using ControlParameters = std::map<std::string, double>;

/// The mean of both wheels: they share kp and ki, so the gains are designed for it.
MotorModel mean_model(const IdentifiedMotors& motors);

/// The gains for a bandwidth (0: the stiffest against loads), and the margins of the gains that the robot has
/// now, on the same motors.
struct GainDesign {
  MotorModel mean;
  Design design;
  Margins margins_before;
};

/// Throws as design_gains does.
GainDesign design_for(const IdentifiedMotors& motors, const RobotFacts& robot, double bandwidth_radps);

/// Throws as design_gains does if the bandwidth is far beyond what the robot's present feed-forward and
/// observer allow, so that nothing needs to be measured first. A robot without a feed-forward passes.
void require_possible_bandwidth(const RobotFacts& robot, double bandwidth_radps);

/// What to load: feed-forward of each wheel, kp and ki, rounded to four digits. With the wheels off the ground
/// kA lacks the robot's mass, and the gains follow from kA, so only kS and kV are proposed.
ControlParameters proposed_parameters(const IdentifiedMotors& motors, const Design& design, bool on_stand);

/// The robot's facts with `values` in force.
RobotFacts with_parameters(RobotFacts robot, const ControlParameters& values);

/// The wheel whose fit is too poor for its values to be loaded; nullopt if both are good enough: R^2 of at
/// least 0.98, and standard errors within 5 % of kV and 20 % of kA.
std::optional<Side> poorly_measured(const IdentifiedMotors& motors);

/// The ratio of the motors' measured kV to that of the robot's feed-forward, if it differs from 1 by more
/// than a calibration explains (factor 1.6). Then there are other motors or wheels, or the counts per
/// revolution are wrong. nullopt if it does not differ so much, or without a feed-forward.
std::optional<double> unlikely_kV_ratio(const MotorModel& mean, const RobotFacts& robot);

}  // namespace astro::motor
