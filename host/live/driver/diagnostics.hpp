#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "host/formats/messages/nodes.hpp"
#include "host/live/driver/continuous_odometry.hpp"
#include "host/live/driver/driving.hpp"

namespace astro::live {

/// What a fault means and what to check; "" if the fault is not known.
using FaultHelp = std::function<std::string_view(Fault)>;

/// The state that /diagnostics reports.
struct DriverState {
  std::int64_t time_ns = 0;  // since 1970
  microseconds now{};        // on the steady clock
  std::string node;
  std::optional<protocol::HelloReply> robot;  // once one has answered
  std::string why_no_robot;                   // "" while there is one
  int losses = 0;                             // of the link
  // While there is a robot:
  std::string port;
  std::optional<protocol::Telemetry> telemetry;  // the newest
  microseconds telemetry_age{};
  robot::LinkCounts counts;
  protocol::FrameCounts frames;
  std::optional<double> clock_drift;
  std::optional<double> stamp_bound_s;  // greatest error of a stamp
  // Always:
  CommandCounts commands;
  std::string_view velocities_ignored;  // why; "" if they drive the robot
  std::string odometry_event;
  std::optional<ContinuousOdometry::RefusedPose> refused_pose;
  bool other_factors = false;  // the robot's wheel factors are not those of the published covariance
};

/// Three statuses: the robot, its link, and the commands of others.
ros2::msg::DiagnosticArray diagnostics(const DriverState& state, const FaultHelp& fault_help);

/// Whether the level or the message of a status differs, so that a person would read something else.
bool says_more(const ros2::msg::DiagnosticArray& now, const ros2::msg::DiagnosticArray& before);

}  // namespace astro::live
