#pragma once

#include <deque>
#include <list>
#include <optional>
#include <span>

#include "host/robot/sharing/relay_session.hpp"

namespace astro::robot {

/// One robot, several programs: carries their frames to the robot and its answers and events back. Moves no
/// bytes and knows no clock of its own: relay_server.hpp does and gives them.
///
/// Requests   each program's ids are replaced by fresh ones, so that an answer returns to the asker only. The
///            program that drives sends with bit 15 of the id clear, all others with it set; of those others
///            only one request is under way at a time, because the robot remembers one answer of theirs.
///            Stop, EmergencyStop and Disarm wait for nobody, and what was to set the robot in motion and has
///            not gone to it yet goes no more.
/// Driver     who first sends Arm, Velocity, WheelVoltage or AddSegment, unless the robot refuses it; until
///            it disarms the robot, says Hello or goes, a fault is raised, or another program stops it. To
///            the others these requests are refused as busy, and to a driver whom another program stopped as
///            not_armed, until it arms the robot again.
/// Hello      answered from the robot's last HelloReply, because a Hello ends a session at the robot.
/// Telemetry  the robot sends what serves all; each program gets the groups and the rate it asked for.
/// Parameters the staging area belongs to the program that sent RevertParameters or DefaultParameters last;
///            what others then stage, commit or apply is refused as staging_lost.
/// Bounds     what a program does not read is dropped: telemetry first; then the program is let go. At most
///            32 drive, change parameters or have telemetry; whoever only looks or stops needs no such place.
class Relay {
 public:
  Relay();

  /// `greets`: a Welcome tells the program that it is served, and a Farewell why it was let go.
  SessionId join(PortUser user, bool greets = true);
  void leave(SessionId id);

  void from_session(SessionId id, std::span<const std::uint8_t> bytes, microseconds now);
  void from_robot(std::span<const std::uint8_t> bytes, microseconds now);

  /// To be called at next_tick() or whenever time has passed.
  void tick(microseconds now);
  /// Nothing: no need to call tick() before something arrives.
  std::optional<microseconds> next_tick() const;

  /// What waits to be written.
  FrameQueue& to_robot() { return to_robot_; }
  FrameQueue& to_session(SessionId id);
  /// Why this session ends once its frames are written.
  std::optional<FarewellReason> closing(SessionId id) const;
  /// Lets everybody go.
  void close_all(FarewellReason reason);

  std::optional<SessionId> driver() const { return driver_; }

 private:
  using Body = std::span<const std::uint8_t>;
  struct Staging {
    bool opened = false;             // through this relay; before that the robot decides
    std::optional<SessionId> owner;  // nobody: closed
  };

  void make_room(RelaySession& newcomer);
  bool give_place(RelaySession& session);
  RelaySession* find(SessionId id);
  const RelaySession* find(SessionId id) const;

  // relay_requests.cpp
  void take(RelaySession& session, Body body, microseconds now);
  bool take_here(RelaySession& session, const protocol::Header& header, Body body);
  void take_hello(RelaySession& session, Exchange exchange, microseconds now);
  void take_telemetry(RelaySession& session, const protocol::Header& header, Body body);
  void take_ping(RelaySession& session, const protocol::Header& header, Body body, microseconds now);
  std::optional<protocol::ErrorReply> refusal(const RelaySession& session, std::uint8_t message) const;
  void depose_driver(const RelaySession& by);
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
  bool driver_confirmed_ = false;  // the robot has taken a motion request of its
  Staging staging_;
  protocol::SetTelemetry stream_;  // what the robot was asked for
  bool ask_again_ = false;         // the wishes have changed since
  std::uint16_t own_requests_ = 0;

  std::deque<SessionId> waiting_;       // onlookers whose request waits for its turn
  std::optional<SessionId> under_way_;  // the onlooker whose request is under way ...
  microseconds give_up_at_{};           // ... which others wait for until then
};

}  // namespace astro::robot
