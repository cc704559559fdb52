#pragma once

#include <list>
#include <optional>

#include "common/protocol/framer.hpp"
#include "host/base/bytes.hpp"
#include "host/robot/sharing/frame_queue.hpp"
#include "host/robot/sharing/port_user.hpp"
#include "host/robot/sharing/relay_messages.hpp"
#include "host/robot/sharing/request_arbiter.hpp"

namespace astro::robot {

/// The connection of one program to the relay: frames from it, and what waits to be written to it.
struct RelaySession {
  SessionId id = 0;
  bool greets = true;  // gets a Welcome and a Farewell

  protocol::Framer framer;
  FrameQueue out;  // to the program
  std::optional<Farewell> closing;
  bool has_slot = false;  // may drive, change parameters or have telemetry

  /// The program has never sent a good frame.
  bool is_silent() const { return framer.counts().good == 0; }
  /// False beyond 64 KiB that wait. A program that computes or waits at a prompt for a while still gets the
  /// answers and events of that time, but of telemetry only as much as a serial port would buffer.
  bool takes_telemetry() const;
  /// Returns false, and drops the frame, beyond 256 KiB that wait: it must be disconnected then.
  [[nodiscard]] bool push(ByteView frame);
  /// From now on only the Farewell is sent to it. Frames that wait already are sent before it, unless the
  /// reason is that the program reads too slowly.
  void close(FarewellReason reason);
};

/// One robot, several programs: passes their frames to the robot and its answers and events back. Which
/// requests go to the robot, and when, is decided by RequestArbiter. The relay does no I/O and has no clock;
/// relay_server.hpp moves the bytes and passes the time.
///
/// Telemetry  each program gets the groups and the rate that it requested; events go to all.
/// Bounds     if a program does not read, its telemetry is dropped first; then it is disconnected. At most 32
///            programs drive, change parameters or have telemetry (they have a slot); asking and stopping
///            needs no slot. If too many are connected, one that has never sent anything is disconnected
///            first, so that hanging programs cannot keep out an emergency stop. From a program that is being
///            disconnected, only the requests that halt the robot are passed on.
class Relay {
 public:
  /// `greets`: the program gets a Welcome when it is served and a Farewell with the reason when it is
  /// disconnected.
  SessionId join(PortUser user, bool greets = true);
  void leave(SessionId id);

  void from_session(SessionId id, ByteView bytes, microseconds now);
  void from_robot(ByteView bytes, microseconds now);

  /// Must be called at next_tick(); may be called at any time.
  void tick(microseconds now);
  /// Nothing: tick() need not be called before bytes arrive.
  std::optional<microseconds> next_tick() const { return requests_.next_tick(); }

  /// Frames that wait to be written.
  FrameQueue& to_robot() { return requests_.to_robot(); }
  FrameQueue& to_session(SessionId id);
  /// Why this session ends as soon as its frames are written; nothing if it does not end.
  std::optional<FarewellReason> closing(SessionId id) const;
  /// Disconnects all programs.
  void close_all(FarewellReason reason);

  std::optional<SessionId> driver() const { return requests_.driver(); }
  /// A driver has gone, and the robot has not yet confirmed the relay's Stop.
  bool owes_stop() const { return requests_.owes_stop(); }

 private:
  RelaySession* find(SessionId id);
  const RelaySession* find(SessionId id) const;
  void make_room(RelaySession& newcomer);
  bool give_slot(RelaySession& session);
  void close(RelaySession& session, FarewellReason reason);
  void push(RelaySession& session, ByteView frame);
  void deliver_replies();
  void take(RelaySession& session, ByteView body, microseconds now);
  void take_event(ByteView body);
  void distribute(const protocol::Telemetry& sample);

  std::list<RelaySession> sessions_;
  SessionId last_session_ = 0;
  protocol::Framer framer_;  // of the robot's bytes
  bool noise_ = false;       // bytes have come, and no good frame yet
  RequestArbiter requests_;
};

}  // namespace astro::robot
