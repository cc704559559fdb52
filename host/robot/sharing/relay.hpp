#pragma once

#include <deque>
#include <list>
#include <optional>
#include <span>

#include "host/robot/sharing/relay_session.hpp"

namespace astro::robot {

/// One robot, several programs: passes their frames to the robot and its answers and events back. It does no
/// I/O and has no clock; relay_server.hpp moves the bytes and passes the time.
///
/// Requests   each program's ids are replaced by new ones, so that an answer returns only to the program that
///            asked. Requests of the driver have bit 15 of the id clear, all others have it set. Of the
///            others (onlookers) only one request is under way at a time, because the robot remembers one
///            answer for all of them. Stop, EmergencyStop and Disarm never wait, and they withdraw requests
///            for motion that have not been sent to the robot yet.
/// Driver     the program that first sends Arm, Velocity, WheelVoltage or AddSegment, unless the robot
///            refuses it. It stays the driver until it disarms the robot, sends Hello or disconnects, a fault
///            is raised, or another program stops it. Meanwhile these requests of others are refused as busy.
///            A driver that another program stopped gets not_armed until it arms the robot again.
/// Hello      answered from the robot's last HelloReply, because a Hello ends a session at the robot.
/// Telemetry  the robot sends one stream that serves all; each program gets the groups and the rate that it
///            requested.
/// Parameters the staging area belongs to the program that last sent RevertParameters or DefaultParameters;
///            if others then stage, commit or apply, they are refused as staging_lost.
/// Bounds     if a program does not read, its telemetry is dropped first; then it is disconnected. At most 32
///            programs drive, change parameters or have telemetry (they have a slot); asking and stopping
///            needs no slot.
class Relay {
 public:
  Relay();

  /// `greets`: the program gets a Welcome when it is served and a Farewell with the reason when it is
  /// disconnected.
  SessionId join(PortUser user, bool greets = true);
  void leave(SessionId id);

  void from_session(SessionId id, std::span<const std::uint8_t> bytes, microseconds now);
  void from_robot(std::span<const std::uint8_t> bytes, microseconds now);

  /// Must be called at next_tick(); may be called at any time.
  void tick(microseconds now);
  /// Nothing: tick() need not be called before bytes arrive.
  std::optional<microseconds> next_tick() const;

  /// Frames that wait to be written.
  FrameQueue& to_robot() { return to_robot_; }
  FrameQueue& to_session(SessionId id);
  /// Why this session ends as soon as its frames are written; nothing if it does not end.
  std::optional<FarewellReason> closing(SessionId id) const;
  /// Disconnects all programs.
  void close_all(FarewellReason reason);

  std::optional<SessionId> driver() const { return driver_; }

 private:
  using Body = std::span<const std::uint8_t>;
  struct Staging {
    bool opened = false;             // through this relay; until then the robot decides
    std::optional<SessionId> owner;  // nothing: closed
  };

  void make_room(RelaySession& newcomer);
  bool give_slot(RelaySession& session);
  RelaySession* find(SessionId id);
  const RelaySession* find(SessionId id) const;

  // relay_requests.cpp
  void take(RelaySession& session, Body body, microseconds now);
  bool take_here(RelaySession& session, const protocol::Header& header, Body body);
  void take_hello(RelaySession& session, Exchange exchange, microseconds now);
  void take_telemetry(RelaySession& session, const protocol::Header& header, Body body);
  void take_ping(RelaySession& session, const protocol::Header& header, Body body, microseconds now);
  std::optional<protocol::ErrorReply> refusal(const RelaySession& session, std::uint8_t message) const;
  void note_stopped_driver(const RelaySession& by);
  void begin(RelaySession& session, Exchange exchange, microseconds now);
  void repeat(RelaySession& session, microseconds now);
  void send(RelaySession& session, Exchange& exchange, microseconds now);
  bool staging_allows(const RelaySession& session, std::uint8_t message);
  void wait_for_turn(RelaySession& session);
  void next_onlooker(microseconds now);
  void ask_for_telemetry(microseconds now);
  std::uint16_t fresh_id(const RelaySession& session);

  // relay_answers.cpp
  void take_answer(const protocol::Header& header, Body body, microseconds now);
  void note_answer(RelaySession& session, std::uint8_t request, Body body);
  void note_motion(RelaySession& session, std::uint8_t request, bool taken);
  void take_event(Body body);
  void distribute(Body telemetry);
  void note_restart();

  void close(RelaySession& session, FarewellReason reason);
  void release(RelaySession& session);
  void push(RelaySession& session, Body frame);
  void reply(RelaySession& session, const protocol::Header& request, Body body);
  template <protocol::Message M>
  void reply_with(RelaySession& session, const protocol::Header& request, const M& message);

  std::list<RelaySession> sessions_;  // the first is the relay itself, which asks for telemetry
  SessionId next_session_ = 1;
  protocol::Framer framer_;
  bool noise_ = false;  // bytes have come, and no good frame yet
  FrameQueue to_robot_;
  std::uint16_t next_id_ = 0;

  std::optional<protocol::HelloReply> hello_;
  std::optional<SessionId> driver_;
  bool driver_confirmed_ = false;  // the robot has accepted a motion request of the driver
  Staging staging_;
  protocol::SetTelemetry stream_;   // what was requested from the robot
  bool telemetry_changed_ = false;  // the programs' requests have changed since
  std::uint16_t own_requests_ = 0;

  std::deque<SessionId> waiting_;       // onlookers whose request waits for its turn
  std::optional<SessionId> under_way_;  // the onlooker whose request is under way ...
  microseconds give_up_at_{};           // ... which others wait for until then
};

}  // namespace astro::robot
