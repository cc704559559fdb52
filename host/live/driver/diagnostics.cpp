#include "host/live/driver/diagnostics.hpp"

#include <fmt/format.h>

#include "host/base/text/numbers.hpp"
#include "host/robot/client/handshake.hpp"

namespace astro::live {
namespace {

enum Level : std::uint8_t { kOk = 0, kWarn = 1, kError = 2, kStale = 3 };

constexpr microseconds kSilent = std::chrono::milliseconds(500);  // without telemetry
constexpr microseconds kRecently = std::chrono::seconds(2);

class Status {
 public:
  Status(const DriverState& state, std::string_view what) {
    status_.name = state.node + ": " + std::string(what);
    if (state.robot)
      for (const std::uint8_t byte : state.robot->unique_id)
        status_.hardware_id += fmt::format("{:02x}", byte);
  }
  void say(Level level, std::string message) {
    status_.level = std::byte{level};
    status_.message = std::move(message);
  }
  void add(std::string key, std::string value) {
    status_.values.push_back({std::move(key), std::move(value)});
  }
  void add(std::string key, std::uint64_t value) { add(std::move(key), std::to_string(value)); }
  const ros2::msg::DiagnosticStatus& message() const { return status_; }

 private:
  ros2::msg::DiagnosticStatus status_;
};

void add_faults(Status& status, std::uint32_t latched, const FaultHelp& help) {
  for (unsigned i = 1; i < 32; ++i) {
    if (((latched >> i) & 1U) == 0) continue;
    const auto fault = static_cast<Fault>(i);
    status.add("fault " + robot::fault_names(std::uint32_t{1} << i), std::string(help(fault)));
  }
}

ros2::msg::DiagnosticStatus robot_status(const DriverState& state, const FaultHelp& help) {
  Status status(state, "robot");
  if (state.robot) {
    status.add("robot", std::string(state.robot->robot_name.view()));
    status.add("firmware", robot::firmware_version(*state.robot));
  }
  if (!state.odometry_event.empty()) status.add("odometry", state.odometry_event);
  if (state.refused_pose) status.add("last pose refused because", state.refused_pose->why);
  if (!state.why_no_robot.empty()) {
    status.say(kStale, "no robot: " + state.why_no_robot);
  } else if (!state.telemetry || state.telemetry_age > kSilent) {
    status.say(kStale, "the robot sends no telemetry");
  } else {
    const protocol::StateGroup& at = state.telemetry->state;
    if (at.latched_faults != 0)
      status.say(kError, "fault: " + robot::fault_names(at.latched_faults));
    else if (state.refused_pose && state.now - state.refused_pose->at < kRecently)
      status.say(kWarn, "a pose was not set: " + state.refused_pose->why);
    else if (state.other_factors)
      status.say(kWarn, "the robot holds other factors than the calibration whose covariance is published");
    else
      status.say(kOk, std::string(protocol::name(at.mode)));
    status.add("mode", std::string(protocol::name(at.mode)));
    status.add("battery", fmt::format("{:.2f} V", 1e-3 * state.telemetry->battery.mv));
    add_faults(status, at.latched_faults, help);
  }
  return status.message();
}

ros2::msg::DiagnosticStatus link_status(const DriverState& state) {
  Status status(state, "link");
  status.add("times lost", static_cast<std::uint64_t>(state.losses));
  if (!state.why_no_robot.empty()) {
    status.say(kError, state.why_no_robot);
    return status.message();
  }
  status.say(kOk, "connected");
  status.add("port", state.port);
  status.add("requests", state.counts.requests);
  status.add("repeated requests", state.counts.repeats);
  status.add("lost pings", state.counts.lost_pings);
  status.add("missed events", state.counts.missed_events);
  status.add("good frames", state.frames.good);
  if (state.stamp_bound_s) status.add("error of stamps", fmt::format("< {:.2g} s", *state.stamp_bound_s));
  if (state.clock_drift)
    status.add("drift of the robot's clock", fmt::format("{:.1f} ppm", 1e6 * *state.clock_drift));
  return status.message();
}

ros2::msg::DiagnosticStatus command_status(const DriverState& state) {
  Status status(state, "commands");
  const CommandCounts& counts = state.commands;
  if (counts.ignored_at && state.now - *counts.ignored_at < kRecently)
    status.say(kWarn, "a velocity is ignored: " + counts.last_reason);
  else
    status.say(kOk, state.velocities_ignored.empty() ? "armed" : std::string(state.velocities_ignored));
  status.add("velocities received", counts.received);
  status.add("velocities ignored", counts.ignored);
  if (!counts.last_reason.empty()) status.add("last ignored because", counts.last_reason);
  status.add("reduced to the robot's limits", counts.reduced ? "yes" : "no");
  return status.message();
}

}  // namespace

ros2::msg::DiagnosticArray diagnostics(const DriverState& state, const FaultHelp& fault_help) {
  return {{ros2::msg::to_time(state.time_ns), ""},
          {robot_status(state, fault_help), link_status(state), command_status(state)}};
}

bool says_more(const ros2::msg::DiagnosticArray& now, const ros2::msg::DiagnosticArray& before) {
  if (now.status.size() != before.status.size()) return true;
  for (std::size_t i = 0; i < now.status.size(); ++i)
    if (now.status[i].level != before.status[i].level || now.status[i].message != before.status[i].message)
      return true;
  return false;
}

}  // namespace astro::live
