#pragma once

#include <optional>

#include "common/protocol/framer.hpp"
#include "host/base/bytes.hpp"
#include "host/robot/arbitration/frame_queue.hpp"
#include "host/robot/arbitration/port_user.hpp"
#include "host/robot/arbitration/relay_messages.hpp"

namespace astro::robot {

/// The connection of one program to the relay: frames from it, and what waits to be written to it.
struct RelaySession {
  SessionId id = 0;
  bool greets = true;  // gets a Welcome and a Farewell

  protocol::Framer framer;
  FrameQueue out;  // to the program
  std::optional<Farewell> closing;
  bool has_slot = false;  // may drive, change parameters or have telemetry

  /// It has never sent anything.
  bool is_silent() const { return framer.counts().good == 0; }
  /// False beyond 64 KiB that wait. A program that computes or waits at a prompt for a while still gets the
  /// answers and events of that time, but of telemetry only as much as a serial port would buffer.
  bool takes_telemetry() const;
  /// Returns false, and drops the frame, beyond 256 KiB that wait: it must be disconnected then.
  [[nodiscard]] bool push(ByteView frame);
  /// Nothing but the Farewell goes to it any more, after what waits already, unless it reads too slowly.
  void close(FarewellReason reason);
};

}  // namespace astro::robot
