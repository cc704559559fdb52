#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "common/protocol/driving_rule.hpp"
#include "host/robot/sharing/port_user.hpp"

namespace astro::robot {

/// Knows which program drives, and whose drive another program has stopped. It applies the robot's own rule
/// (protocol::DrivingRule) to the programs at one port, which the robot sees as one host.
///
/// Begin  the program that sends Arm drives, unless the robot refuses it. Meanwhile motion requests of others are refused as
///        busy.
/// End    the drive ends if the robot is disarmed, if the driver sends Hello or disconnects, or if a fault is raised. Once
///        anybody has stopped the driver, the next program that arms the robot takes its place.
/// Gone   if a driver disconnects or sends Hello, RequestArbiter stops the robot.
/// Stop   a driver that was stopped gets not_armed for every request that would move the robot, until it arms the robot
///        again.
class DriverRule {
 public:
  std::optional<SessionId> driver() const { return driver_; }
  bool drives(SessionId id) const { return driver_ == id; }
  /// The driver, once the robot has accepted its Arm and until somebody stops it.
  std::optional<SessionId> confirmed_driver() const;
  /// The program that stopped the robot since this one armed it or connected; null if none has.
  const PortUser* stopper_of(SessionId id) const;
  /// Returns how often others have stopped the robot, for the status reply to this program, and remembers that it knows.
  /// `at_robot`: the robot's own count for this port, in which all programs here are one host.
  std::uint16_t tell_stops(SessionId id, std::uint16_t at_robot);
  /// True if this program drives and no stop at this port has certainly ended its drive. A stop at the robot's other port is
  /// visible only in refused requests and looks like a pause there, so it does not count.
  bool may_move(SessionId id) const { return drives(id) && !(confirmed_ && certainly_stopped_); }

  /// Why the request must not go to the robot; nothing if it may.
  std::optional<protocol::ErrorReply> refusal(SessionId id, std::uint8_t message) const;

  /// To be called for a new request that was not refused.
  void note_request(SessionId id, std::uint8_t message);
  /// To be called for a request that halts the robot. It is noted when it arrives, not when the robot answers, so that no
  /// motion request is sent to the robot after it.
  void note_halt(SessionId id, std::uint8_t message, const PortUser& by);
  /// The robot has answered a request of this program, and refused it if there is a code.
  void note_answer(SessionId id, std::uint8_t request, std::optional<protocol::ErrorCode> refused);
  /// Nobody drives any more.
  void end_drive();
  void join(SessionId id) { stops_.try_emplace(id); }
  /// The program has said Hello again, or its connection ends: it does not drive any more.
  void release(SessionId id);
  /// The program has disconnected.
  void remove(SessionId id);

 private:
  void note_answer_to_arm(SessionId id, bool accepted);

  protocol::DrivingRule<SessionId> rule_;
  std::optional<SessionId> driver_;  // from its Arm on; rule_'s driver from when the robot has accepted it
  std::optional<SessionId>
      last_;  // who has armed the robot last; its own stops are not counted as the stops of another
  bool confirmed_ = false;          // the robot has accepted the driver's Arm
  bool certainly_stopped_ = false;  // the robot has carried out a stop since
  /// What a program knows of the stops of others.
  struct Stops {
    std::optional<PortUser> by;
    std::uint16_t own = 0;              // those among all_stops_ that it has sent itself
    std::optional<std::uint16_t> told;  // in its last status; none: it has not asked yet
  };
  std::uint16_t stops_of_others(SessionId id) const;

  std::map<SessionId, Stops> stops_;  // of all programs
  std::uint16_t all_stops_ = 0, stops_at_robot_ = 0;
};

}  // namespace astro::robot
