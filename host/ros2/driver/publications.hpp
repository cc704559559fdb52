#pragma once

#include <span>
#include <string_view>

#include "host/ros2/driver/names.hpp"
#include "host/ros2/driver/outlet.hpp"
#include "host/ros2/messages/diagnostics.hpp"
#include "host/ros2/messages/odometry.hpp"
#include "host/ros2/messages/sensors.hpp"
#include "host/ros2/messages/telemetry.hpp"
#include "host/ros2/messages/text.hpp"

namespace astro::ros2 {

/// All that the driver publishes. host/ros2/README.md has the same as a table, and a test compares both.
class Publications {
 public:
  Publications(std::span<Middleware* const> middlewares, const Names& names)
      : odometry(middlewares, {names.absolute("odom"), {}}),
        tf(middlewares, {names.absolute("/tf"), {}, true, false, 100}),
        tf_static(middlewares, {names.absolute("/tf_static"), {}, true, true, 1}),
        robot_description(middlewares, {names.absolute("robot_description"), {}, true, true, 1}),
        joint_states(middlewares, {names.absolute("joint_states"), {}}),
        battery_state(middlewares, {names.absolute("battery_state"), {}}),
        diagnostics(middlewares, {names.absolute("/diagnostics"), {}}),
        telemetry(middlewares, {names.absolute("telemetry"), {}, false, false, 5}) {}

  Outlet<msg::Odometry> odometry;
  Outlet<msg::TFMessage> tf, tf_static;
  Outlet<msg::String> robot_description;
  Outlet<msg::JointState> joint_states;
  Outlet<msg::BatteryState> battery_state;
  Outlet<msg::DiagnosticArray> diagnostics;
  Outlet<msg::Telemetry> telemetry;
};

}  // namespace astro::ros2
