#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "common/protocol/driving_rule.hpp"
#include "host/robot/sharing/port_user.hpp"

namespace astro::robot {

/// Which program drives, and whose drive another program stopped: the robot's own rule (protocol::DrivingRule), applied to the
/// programs at one port, which are one host to the robot.
///
/// Begin  the program that sends Arm drives, unless the robot refuses it. Meanwhile motion requests of others are refused as
///        busy.
/// End    it disarms the robot, says Hello or disconnects, or a fault is raised. Once it was stopped, by whomever, the next
///        program that arms the robot takes its place.
/// Gone   the robot is stopped for a driver that disconnects or says Hello (RequestArbiter).
/// Stop   a driver that was stopped gets not_armed for whatever would move the robot, until it arms the robot again.
class DriverRule {
 public:
  std::optional<SessionId> driver() const { return driver_; }
  bool drives(SessionId id) const { return driver_ == id; }
  /// The driver, once the robot has accepted its Arm and until somebody stops it.
  std::optional<SessionId> confirmed_driver() const;
  /// The program that stopped the robot since this one armed it or connected; null if none has.
  const PortUser* stopper_of(SessionId id) const;
  /// How often others have stopped the robot, for the status that this program gets: `at_robot` is the robot's own count for this
  /// port, to which all programs here are one.
  std::uint16_t tell_stops(SessionId id, std::uint16_t at_robot);
  /// It drives, and no stop at this port has ended that for certain: what happens at the robot's other port shows only in what
  /// the robot refuses, and a pause there looks like a stop.
  bool may_move(SessionId id) const { return drives(id) && !(confirmed_ && certainly_stopped_); }

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
  void join(SessionId id) { stops_.try_emplace(id); }
  /// The program has said Hello again, or its connection ends: it does not drive any more.
  void release(SessionId id);
  /// The program has disconnected.
  void remove(SessionId id);

 private:
  void note_answer_to_arm(SessionId id, bool accepted);

  protocol::DrivingRule<SessionId> rule_;
  std::optional<SessionId> driver_;  // from when it asks for it, the rule's from when the robot has agreed
  std::optional<SessionId>
      last_;  // who has armed the robot last; its stops end its own drive and count for nobody else
  bool confirmed_ = false;          // the robot has agreed
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
