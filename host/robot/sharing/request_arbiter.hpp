#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "host/robot/sharing/driver_rule.hpp"
#include "host/robot/sharing/program_session.hpp"
#include "host/robot/sharing/relay_messages.hpp"
#include "host/robot/sharing/robot_queue.hpp"
#include "host/robot/sharing/staging_area.hpp"
#include "host/robot/sharing/telemetry_stream.hpp"
#include "host/robot/sharing/turns.hpp"

namespace astro::robot {

/// A frame for a program: the answer to a request.
struct Reply {
  SessionId to = 0;
  Bytes frame;
};

/// Decides which requests of all programs go to the robot and when, and answers the others.
///
/// Ids        each program's request ids are replaced by new ones, so that an answer returns only to the
///            program that asked (exchange.hpp, robot_queue.hpp).
/// Driver     one program at a time drives; the others are refused as busy (driver_rule.hpp). Requests of
///            programs that do not drive take turns (turns.hpp).
/// Gone       if a driver that may move the robot disconnects or sends Hello, the relay stops the robot, because nobody else
///            would. Until the robot has confirmed that Stop, no Arm goes to it.
/// Halt       Stop, EmergencyStop, Disarm and Pause never wait. Requests for motion that other programs sent
///            before, and that wait or have no answer yet, end as refused: the robot does not get them later.
/// Hello      answered from the robot's last HelloReply, because a Hello ends a session at the robot.
/// Telemetry  the robot sends one stream that serves all (telemetry_stream.hpp). The request for that stream and the Stop
///            for a driver that has gone are the only requests of the relay itself, and the only ones that it repeats until
///            the robot answers.
/// Status     the relay replaces the count of stops by others with that of the program that asks, because the robot cannot
///            tell the programs at this port apart.
/// Parameters if two programs change them at the same time, the one whose staged values are gone is refused as
///            staging_lost (staging_area.hpp).
class RequestArbiter {
 public:
  RequestArbiter();

  void join(SessionId id, PortUser user);
  /// Drops everything that the program requested. If it drives, the robot is stopped with the next request or tick.
  void release(SessionId id);
  void leave(SessionId id);

  /// True if the program repeats the request that it has under way.
  bool repeats(SessionId id, const protocol::Header& request) const;
  /// A request of a program that has joined, with a request id other than 0.
  void take(SessionId id, ByteView body, microseconds now);
  /// An answer of the robot.
  void take_answer(ByteView body, microseconds now);
  /// An event of the robot, which may end a drive or mean that the robot has forgotten everything.
  void take_event(ByteView body);
  /// Must be called at next_tick(); may be called at any time.
  void tick(microseconds now);
  std::optional<microseconds> next_tick() const;
  /// A driver has gone, and the robot has not yet confirmed the relay's Stop.
  bool owes_stop() const { return drive_left_ || sessions_.at(kGuard).current() != nullptr; }

  /// The replies since the last call.
  std::vector<Reply> take_replies() { return std::exchange(replies_, {}); }
  /// The part of a telemetry sample that this program requested; nothing if it requested none of it.
  std::optional<protocol::Telemetry> telemetry_for(SessionId id, const protocol::Telemetry& sample) {
    return telemetry_.part_for(id, sample);
  }
  /// Frames that wait to be written.
  FrameQueue& to_robot() { return to_robot_.frames(); }
  std::optional<SessionId> driver() const { return driver_.driver(); }

 private:
  using Header = protocol::Header;
  // The relay's own sessions: kGuard stops the robot for a driver that has gone, kSelf requests telemetry.
  static constexpr SessionId kGuard = -1, kSelf = 0;

  void reply(ProgramSession& session, const Header& request, ByteView body);
  template <protocol::Message M>
  void reply_with(ProgramSession& session, const Header& request, const M& message);
  bool answer_here(ProgramSession& session, const Header& header, ByteView body);
  PortUsers users_for(SessionId session) const;
  void stop_for_gone_driver(microseconds now);
  Bytes for_program(const ProgramSession& session, const Header& asked, ByteView body);
  void take_telemetry(ProgramSession& session, const Header& header, ByteView body);
  void take_hello(ProgramSession& session, Exchange exchange, microseconds now);
  void begin(ProgramSession& session, Exchange exchange, microseconds now);
  void repeat(ProgramSession& session, microseconds now);
  void send(const ProgramSession& session, Exchange& exchange, microseconds now);
  void cancel_motion(SessionId by, std::uint8_t halt);
  bool staging_allows(ProgramSession& session);
  void next_onlooker(microseconds now);
  void note_answer(const ProgramSession& session, std::uint8_t request, ByteView body);
  void note_restart();

  std::map<SessionId, ProgramSession> sessions_;  // the first two are the relay itself
  std::vector<Reply> replies_;
  std::optional<protocol::HelloReply> hello_;
  RobotQueue to_robot_;
  DriverRule driver_;
  Turns turns_;
  TelemetryStream telemetry_;
  StagingArea staging_;
  bool drive_left_ = false;  // a driver has gone, and no Stop was sent for it yet
  bool greeted_ = false;     // the robot has answered a Hello since it started
};

}  // namespace astro::robot
