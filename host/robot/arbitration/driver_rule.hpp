#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "common/protocol/driving_rule.hpp"
#include "host/robot/arbitration/port_user.hpp"

namespace astro::robot {

/// Which program drives, and whose drive another program stopped: the robot's own rule (protocol::DrivingRule), applied to the
/// programs at one port, which are one host to the robot.
///
/// Begin  the program that sends Arm drives, unless the robot refuses it. Meanwhile motion requests of others are refused as
///        busy.
/// End    it disarms the robot, says Hello or disconnects, or a fault is raised. Once it was stopped, by whomever, the next
///        program that arms the robot takes its place.
/// Gone   the robot is stopped if its driver disconnects or says Hello (RequestArbiter).
/// Stop   a driver that was stopped gets not_armed for whatever would move the robot, until it arms the robot again.
class DriverRule {
 public:
  std::optional<SessionId> driver() const { return driver_; }
  bool drives(SessionId id) const { return driver_ == id; }
  /// The driver, once the robot has accepted its Arm and until somebody stops it.
  std::optional<SessionId> confirmed_driver() const;
  /// The program that stopped the robot since this one armed it, during its drive or after; null if none has.
  const PortUser* stopper_of(SessionId id) const;
  /// This program has asked to drive since it connected.
  bool has_driven(SessionId id) const { return stoppers_.contains(id); }

  /// Why the request must not go to the robot; nothing if it may.
  std::optional<protocol::ErrorReply> refusal(SessionId id, std::uint8_t message) const;

  /// A request that was not refused is new.
  void note_request(SessionId id, std::uint8_t message);
  /// A program halts the robot. Noted when it asks, not when the robot answers, so that nothing that moves the robot is sent
  /// after it.
  void note_halt(SessionId id, std::uint8_t message, const PortUser& by);
  /// The robot has answered a request of this program, and refused it if there is a code.
  void note_answer(SessionId id, std::uint8_t request, std::optional<protocol::ErrorCode> refused);
  /// Nobody drives any more.
  void end_drive();
  /// This program begins anew, or has disconnected: it does not drive any more.
  void release(SessionId id);
  /// The robot has restarted.
  void clear();

 private:
  void note_answer_to_arm(SessionId id, bool accepted);

  protocol::DrivingRule<SessionId> rule_;
  std::optional<SessionId> driver_;  // from when it asks for it, the rule's from when the robot has agreed
  bool confirmed_ = false;           // the robot has agreed
  std::map<SessionId, std::optional<PortUser>> stoppers_;  // of those who have asked to drive
};

}  // namespace astro::robot
