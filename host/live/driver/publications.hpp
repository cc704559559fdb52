#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "host/calibration/likelihood/matrix3.hpp"
#include "host/formats/cdr/codec.hpp"
#include "host/formats/messages/geometry.hpp"
#include "host/formats/messages/nodes.hpp"
#include "host/formats/messages/robot_model.hpp"
#include "host/formats/messages/sensors.hpp"
#include "host/formats/messages/std.hpp"
#include "host/formats/messages/telemetry.hpp"
#include "host/live/driver/middleware.hpp"
#include "host/live/driver/names.hpp"
#include "host/live/driver/twist_uncertainty.hpp"
#include "host/recording/run.hpp"
#include "host/robot/client/client.hpp"

/// What the driver publishes: messages made from what the robot measured in one tick, and where they go. Frames by REP 105:
/// odom -> base_footprint -> base_link -> wheels.
namespace astro::live {

struct BaseState {
  std::int64_t time_ns = 0;  // since 1970
  recording::OdometrySample sample;
  calibration::Symmetric3 covariance;  // of the sample's pose
  TwistCovariance twist;
  std::int64_t left_counts = 0, right_counts = 0;  // of the wheels; they do not wrap
};

/// The variance of what a robot on a floor does not measure: z, roll and pitch.
inline constexpr double kNotMeasured = 1e6;

ros2::msg::Odometry odometry(const BaseState& state, const Names& names);
/// odom -> base_footprint unless somebody else publishes it, and base_link -> each wheel if the model is complete.
ros2::msg::TFMessage transforms(const BaseState& state, const ros2::RobotModel& model, const Names& names,
                                bool with_odometry = true);
/// base_footprint -> base_link, which is the same place: the floor between the wheels. Nothing if odometry is that of base_link.
ros2::msg::TFMessage fixed_transforms(std::int64_t time_ns, const Names& names);
/// Angles and speeds of the wheels. `factors`: those that the robot computes its speeds with. Precondition: the model is
/// complete.
ros2::msg::JointState joints(const BaseState& state, const protocol::Telemetry& telemetry,
                             const ros2::RobotModel& model, const calibration::WheelFactors& factors);
ros2::msg::BatteryState battery(std::int64_t time_ns, double voltage_V, const Names& names);
ros2::msg::Telemetry telemetry(const BaseState& state, const protocol::Telemetry& telemetry,
                               const Names& names);

/// A topic on several middlewares at once: a message is encoded once for all, and not at all if nobody would get it.
template <ros2::Message M>
class Outlet {
 public:
  /// `topic.type` is filled in. Throws astro::Error if a middleware refuses the topic.
  Outlet(std::span<Middleware* const> middlewares, TopicDescription topic) : latched_(topic.latched) {
    topic.type = message_type<M>();
    for (Middleware* each : middlewares) publishers_.push_back(each->advertise(topic));
  }

  /// Always true for a latched topic, because somebody may subscribe later.
  bool wanted() const {
    return latched_ || std::any_of(publishers_.begin(), publishers_.end(),
                                   [](const auto& each) { return each->has_subscribers(); });
  }

  void publish(const M& message, std::int64_t time_ns) {
    if (!wanted()) return;
    const Bytes bytes = ros2::encode(message);
    for (const auto& each : publishers_) each->publish(bytes, time_ns);
  }

 private:
  std::vector<std::unique_ptr<Publisher>> publishers_;
  bool latched_;
};

/// All that the driver publishes. host/live/README.md has the same as a table, and a test compares both.
class Publications {
 public:
  Publications(std::span<Middleware* const> middlewares, const Names& names)
      : odometry(middlewares, {names.absolute("odom"), {}}),
        odometry_with_gyro(middlewares, {names.absolute("odom_gyro"), {}}),
        tf(middlewares, {names.absolute("/tf"), {}, true, false, 100}),
        tf_static(middlewares, {names.absolute("/tf_static"), {}, true, true, 1}),
        robot_description(middlewares, {names.absolute("robot_description"), {}, true, true, 1}),
        joint_states(middlewares, {names.absolute("joint_states"), {}}),
        battery_state(middlewares, {names.absolute("battery_state"), {}}),
        diagnostics(middlewares, {names.absolute("/diagnostics"), {}}),
        telemetry(middlewares, {names.absolute("telemetry"), {}, false, false, 5}) {}

  Outlet<ros2::msg::Odometry> odometry, odometry_with_gyro;
  Outlet<ros2::msg::TFMessage> tf, tf_static;
  Outlet<ros2::msg::String> robot_description;
  Outlet<ros2::msg::JointState> joint_states;
  Outlet<ros2::msg::BatteryState> battery_state;
  Outlet<ros2::msg::DiagnosticArray> diagnostics;
  Outlet<ros2::msg::Telemetry> telemetry;
};

}  // namespace astro::live
