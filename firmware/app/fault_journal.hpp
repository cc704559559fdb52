#pragma once

#include "common/protocol/enums.hpp"
#include "common/protocol/fault_log.hpp"
#include "common/safety/fault_log.hpp"
#include "common/safety/pending_faults.hpp"
#include "firmware/app/drive.hpp"

namespace astro {

/// Carries faults from the tick into the log in flash: what was going on is noted in the tick that finds a
/// fault, and written by the main loop once the robot stands with its outputs off, since the processor may
/// stand still while the flash erases.
template <NorFlash Flash, class Mark>
class FaultJournal {
 public:
  using Reply = Result<protocol::FaultLogEntry, protocol::ErrorReply>;

  FaultJournal(Flash& flash, Mark mark) : log_(flash), mark_(mark) {
    const auto last = log_.get(0);
    if (last) start_ = last->start + 1;
    told_already_ = last && last->was.fault == Fault::flash && last->was.time_us < kStarting_us;
  }

  /// Once a tick, before it moves anything, and before faults are cleared: what the tick before found, and the
  /// main loop since. `then_us` is that tick's time. Not inlined: that would take registers from control and
  /// odometry.
  [[gnu::noinline]] void watch(const Drive& drive, std::uint64_t then_us, std::int32_t battery_mv) {
    const std::uint32_t mask = drive.faults().mask();
    const std::uint32_t fresh = (mask & ~seen_) | at_start_;
    if (fresh != 0) note(fresh, drive.wheels().speeds(), then_us, battery_mv);
    seen_ = mask;
    mode_ = drive.mode();
  }

  /// Parameters were committed that cannot be read any more; the robot runs with those before them. Once in a
  /// row of starts: the next one finds the same.
  void parameters_fell_back() {
    if (!told_already_) at_start_ = bit(Fault::flash);
  }

  /// From the main loop, as often as it goes: at most one entry a turn.
  template <class Board>
  [[gnu::cold]] void write(Board& board, const Drive& drive) {
    FaultCircumstances oldest;
    {
      auto hold = board.hold_tick();
      if (pending_.empty() || drive.armed() || !drive.stands()) return;  // open bridges let it roll on
      oldest = pending_.pop();
    }
    // One that the flash does not take is dropped: trying again for ever would only wear it further.
    static_cast<void>(log_.append(oldest, start_));
    mark_.refresh();  // the sector may have been erased
  }

  [[gnu::cold]] Reply entry(std::uint16_t index) const {
    const auto found = log_.get(index);
    if (!found) return protocol::ErrorReply{protocol::ErrorCode::out_of_range, 0};
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
  static constexpr std::uint64_t kStarting_us = 100'000;  // longer than the first tick takes to come

  void note(std::uint32_t fresh, const WheelSpeeds& speeds, std::uint64_t then_us, std::int32_t battery_mv) {
    at_start_ = 0;
    for (unsigned i = 1; i < 32; ++i) {
      if ((fresh >> i & 1U) == 0) continue;
      pending_.offer({.time_us = then_us,
                      .battery_mv = battery_mv,
                      .left_umps = speeds.left_umps,
                      .right_umps = speeds.right_umps,
                      .fault = static_cast<Fault>(i),
                      .mode = static_cast<std::uint8_t>(mode_)});
    }
  }

  FaultLog<Flash> log_;
  Mark mark_;
  PendingFaults pending_;
  std::uint32_t start_ = 1;
  std::uint32_t seen_ = 0, at_start_ = 0;
  protocol::Mode mode_{};  // before the tick that found the fault
  bool told_already_ = false;
};

}  // namespace astro
