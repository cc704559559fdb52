#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "common/protocol/messages.hpp"
#include "host/robot/arbitration/port_user.hpp"

namespace astro::robot {

/// Which program drives, and whose drive another program stopped.
///
/// Begin  the program that first sends Arm, Velocity, WheelVoltage or AddSegment drives, unless the robot
///        refuses it. Meanwhile these requests of others are refused as busy.
/// End    it disarms the robot, says Hello or disconnects, or a fault is raised. Once another program has
///        stopped it, the next program that asks to drive takes its place.
/// Stop   a driver that another program stopped gets not_armed for whatever would move the robot, until it
///        arms the robot again.
class DriverRule {
 public:
  std::optional<SessionId> driver() const { return driver_; }
  bool drives(SessionId id) const { return driver_ == id; }
  /// The driver, once the robot has accepted one of its motion requests.
  std::optional<SessionId> confirmed_driver() const { return confirmed_ ? driver_ : std::nullopt; }
  /// The program that stopped this one's drive; null if none has since it armed the robot.
  const PortUser* stopper_of(SessionId id) const;

  /// Why the request must not go to the robot; nothing if it may.
  std::optional<protocol::ErrorReply> refusal(SessionId id, std::uint8_t message) const;

  /// A request that was not refused is new.
  void note_request(SessionId id, std::uint8_t message);
  /// A program stops the robot: the driver's next velocity is refused, so that it stays stopped.
  void note_stop(SessionId id, const PortUser& by);
  /// The robot has answered a request of this program.
  void note_answer(SessionId id, std::uint8_t request, bool accepted);
  /// Nobody drives any more.
  void end_drive() { driver_.reset(); }
  /// This program does not drive any more.
  void release(SessionId id);
  /// The program has disconnected.
  void remove(SessionId id);
  /// The robot has restarted.
  void clear();

 private:
  std::optional<SessionId> driver_;
  bool confirmed_ = false;                 // the robot has accepted a motion request of the driver
  std::map<SessionId, PortUser> stopped_;  // by whom
};

}  // namespace astro::robot
