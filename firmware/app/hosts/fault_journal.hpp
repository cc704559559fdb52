#pragma once

#include <cstdint>

#include "common/protocol/fault_log.hpp"
#include "common/protocol/session.hpp"
#include "common/safety/fault_log.hpp"
#include "firmware/app/tick/tick_state.hpp"

namespace astro {

/// The log of faults in flash. The tick notes what the robot was doing when a fault came (FaultWatch); the
/// main loop writes it here when the wheels have stopped with the outputs off, because the processor may have
/// to wait while the flash erases.
template <NorFlash Flash, class Mark>
class FaultJournal {
 public:
  FaultJournal(Flash& flash, Mark mark) : log_(flash), mark_(mark) {
    constexpr std::uint64_t kStarting_us = 100'000;  // longer than the first tick takes to come
    const auto newest = log_.get(0);
    if (!newest) return;
    start_ = newest->start + 1;
    if (newest->was.time_us < kStarting_us) newest_at_a_start_ = newest->was.fault;
  }

  /// The newest entry is this fault, and it was found while the robot started. If this start finds the same,
  /// it need not log it again.
  bool newest_is_of_a_start(Fault fault) const { return newest_at_a_start_ == fault; }

  /// Writes at most one entry. Called as often as the main loop runs.
  template <class Board, class SharedState>
  [[gnu::cold]] void write(Board& board, SharedState& shared) {
    FaultCircumstances oldest;
    {
      const auto hold = board.hold_tick();
      auto& state = shared.get(hold);
      // With open bridges the robot may still roll.
      if (state.faults.empty() || state.drive.armed() || !state.drive.stopped_without_power()) return;
      oldest = state.faults.pop();
    }
    // An entry that the flash does not take is dropped: trying again for ever would only wear the flash.
    static_cast<void>(log_.append(oldest, start_));
    mark_.refresh();  // the sector may have been erased
  }

  [[gnu::cold]] protocol::Answer<protocol::FaultLogEntry> entry(std::uint16_t index) const {
    const auto found = log_.get(index);
    if (!found) return protocol::ErrorReply{protocol::ErrorCode::out_of_range};
    return protocol::FaultLogEntry{.number = found->number,
                                   .start = found->start,
                                   .device_time_us = found->was.time_us,
                                   .fault = static_cast<std::uint8_t>(found->was.fault),
                                   .mode = found->was.mode,
                                   .battery_mv = found->was.battery_mv,
                                   .left_umps = found->was.left_umps,
                                   .right_umps = found->was.right_umps,
                                   .missed = found->was.missed};
  }

 private:
  FaultLog<Flash> log_;
  Mark mark_;
  std::uint32_t start_ = 1;
  Fault newest_at_a_start_ = Fault::none;  // none: the newest entry is of a later time
};

}  // namespace astro
