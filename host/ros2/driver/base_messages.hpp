#pragma once

#include <cstdint>

#include "host/calibration/likelihood/matrix3.hpp"
#include "host/recording/run/run.hpp"
#include "host/robot/client/client.hpp"
#include "host/ros2/driver/names.hpp"
#include "host/ros2/messages/odometry.hpp"
#include "host/ros2/messages/sensors.hpp"
#include "host/ros2/messages/telemetry.hpp"
#include "host/ros2/odometry/twist_uncertainty.hpp"
#include "host/ros2/recorded/robot_model.hpp"

/// What the robot measured in one tick, as messages. Frames by REP 105: odom -> base_footprint -> base_link -> wheels.
namespace astro::ros2 {

struct BaseState {
  std::int64_t time_ns = 0;  // since 1970
  recording::OdometrySample sample;
  calibration::Symmetric3 covariance;  // of the sample's pose
  TwistCovariance twist;
  std::int64_t left_counts = 0, right_counts = 0;  // of the wheels; they do not wrap
};

/// The variance of what a robot on a floor does not measure: z, roll and pitch.
inline constexpr double kNotMeasured = 1e6;

msg::Odometry odometry(const BaseState& state, const Names& names);
/// odom -> base_footprint unless somebody else publishes it, and base_link -> each wheel if the model is complete.
msg::TFMessage transforms(const BaseState& state, const RobotModel& model, const Names& names,
                          bool with_odometry = true);
/// base_footprint -> base_link, which is the same place: the floor between the wheels. Nothing if odometry is that of base_link.
msg::TFMessage fixed_transforms(std::int64_t time_ns, const Names& names);
/// Angles and speeds of the wheels. `factors`: those that the robot's speeds are made with. Precondition: the model is complete.
msg::JointState joints(const BaseState& state, const protocol::Telemetry& telemetry, const RobotModel& model,
                       const calibration::WheelFactors& factors);
msg::BatteryState battery(std::int64_t time_ns, double voltage_V, const Names& names);
msg::Telemetry telemetry(const BaseState& state, const protocol::Telemetry& telemetry, const Names& names);

}  // namespace astro::ros2
