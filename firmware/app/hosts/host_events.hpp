#pragma once

#include <cstdint>
#include <type_traits>

#include "common/protocol/messages.hpp"
#include "firmware/app/hosts/event_log.hpp"
#include "firmware/app/hosts/frame_writer.hpp"
#include "firmware/app/tick/control_tick.hpp"

namespace astro {

/// The events that hosts get without asking: collects them from the tick and sends them to each port as far
/// as the port has room. Main loop only.
template <hal::Board Board>
class HostEvents {
 public:
  HostEvents(Board& board, SharedState<Board>& state)
      : board_(board), state_(state), writer_(board.ports()) {}

  void note_start(protocol::ResetCause cause) {
    log_.note({0, static_cast<std::uint16_t>(cause), HostEvent::Kind::booted});
  }

  /// Takes over what the tick and the main loop have to report. Faults come before the segments that they
  /// ended, so that a host knows why a segment ended.
  void collect() {
    static_assert(
        static_cast<int>(HostEvent::Kind::segment_started) == static_cast<int>(SegmentEvent::Kind::started) &&
        static_cast<int>(HostEvent::Kind::segment_completed) ==
            static_cast<int>(SegmentEvent::Kind::completed) &&
        static_cast<int>(HostEvent::Kind::segment_aborted) == static_cast<int>(SegmentEvent::Kind::aborted));
    while (true) {
      SegmentEvent event;
      std::uint32_t fresh = 0;
      UnseenTurn slip;
      bool none = false, slipped = false;
      {
        const auto hold = board_.hold_tick();
        auto& state = state_.get(hold);
        Drive& drive = state.drive;
        slipped = state.gyro.take_slip(slip);
        fresh = drive.faults().mask() & ~reported_faults_;
        reported_faults_ = drive.faults().mask();
        none = drive.events().empty();
        if (!none) event = drive.events().pop();
      }
      if (slipped)
        log_.note({slip.time_us, static_cast<std::uint16_t>(slip.turn_100urad), HostEvent::Kind::slip_found});
      note_faults(fresh);
      if (none) return;
      log_.note({event.time_us, event.tag, static_cast<HostEvent::Kind>(event.kind)});
    }
  }

  /// Clears the latched faults; false if the state does not allow it. A fault that came since the last tick,
  /// or only now, is logged and reported before it is cleared.
  bool clear_faults() {
    collect();
    std::uint32_t fresh = 0;
    {
      const auto hold = board_.hold_tick();
      auto& state = state_.get(hold);
      state.faults.watch(state.drive, state.clock.last_us(), state.battery_mv);
      fresh = state.drive.faults().mask() & ~reported_faults_;
      if (!state.drive.clear_faults()) return false;
      reported_faults_ = 0;
    }
    note_faults(fresh);
    return true;
  }

  /// Sends the events that this port has not got yet. False if some still wait for room.
  bool send(int port) {
    if (const std::uint16_t missed = log_.missed(port); missed != 0) {
      if (!writer_.send_event(port, protocol::EventsMissed{missed})) return false;
      log_.forget_missed(port);
    }
    while (!log_.empty(port)) {
      if (!send(port, log_.front(port))) return false;
      log_.pop(port);
    }
    return true;
  }

  /// A new host has begun at this port: it does not get what the host before it has not read.
  void skip(int port) { log_.skip(port); }

 private:
  using Ports = std::remove_reference_t<decltype(std::declval<Board&>().ports())>;

  void note_faults(std::uint32_t fresh) {
    const std::uint64_t now_us = board_.clock().now_us();
    for (std::uint16_t i = 1; fresh != 0 && i < kFaultNames.size(); ++i)
      if ((fresh & bit(static_cast<Fault>(i))) != 0) log_.note({now_us, i, HostEvent::Kind::fault_raised});
  }

  bool send(int port, const HostEvent& event) {
    using protocol::SegmentOutcome;
    switch (event.kind) {
      case HostEvent::Kind::segment_started:
        return writer_.send_event(port, protocol::SegmentStarted{event.number, event.time_us});
      case HostEvent::Kind::segment_completed:
        return send_done(port, event, SegmentOutcome::completed);
      case HostEvent::Kind::segment_aborted:
        return send_done(port, event, SegmentOutcome::aborted);
      case HostEvent::Kind::fault_raised:
        return writer_.send_event(port,
                                  protocol::FaultRaised{static_cast<Fault>(event.number), event.time_us});
      case HostEvent::Kind::booted:
        return writer_.send_event(port, protocol::Booted{static_cast<protocol::ResetCause>(event.number)});
      case HostEvent::Kind::slip_found:
        return writer_.send_event(
            port, protocol::SlipFound{event.time_us, static_cast<std::int16_t>(event.number)});
    }
    return true;
  }
  bool send_done(int port, const HostEvent& event, protocol::SegmentOutcome outcome) {
    return writer_.send_event(port, protocol::SegmentDone{event.number, outcome, event.time_us});
  }

  Board& board_;
  SharedState<Board>& state_;
  FrameWriter<Ports> writer_;
  EventLog<Ports::kPorts> log_;
  std::uint32_t reported_faults_ = 0;
};

}  // namespace astro
