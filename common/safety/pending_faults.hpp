#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "common/safety/fault_record.hpp"

namespace astro {

/// Faults that wait to be logged until the robot has stopped, the oldest first, because the first fault is
/// the cause of the others. Faults that do not fit are counted in `missed` of the next entry.
///
/// A storm of faults must neither wear out the flash nor push older faults out of it: a host that clears a
/// fault again and again can make it come back a thousand times a second. Therefore
///   * a fault that comes within kSame_us after the same fault is not logged again
///   * of all others kBurst are logged at once, and then one per kEvery_us
/// Two sectors of 64 entries that endure 100,000 erases each then last through 24 years of storm.
///
/// Cost    120 bytes on the Teensy.
class PendingFaults {
 public:
  static constexpr std::size_t kRoom = 4;
  static constexpr std::uint64_t kSame_us = 1'000'000;
  static constexpr std::uint64_t kBurst = 16, kEvery_us = 60'000'000;

  void offer(const FaultCircumstances& was) {
    const bool repeated = was.fault == last_ && was.time_us - last_us_ < kSame_us;
    const bool storm = paid_until_us_ > was.time_us + (kBurst - 1) * kEvery_us;
    if (repeated || storm || count_ == kRoom) {
      if (missed_ != 0xFFFF) ++missed_;
      return;
    }
    last_ = was.fault;
    last_us_ = was.time_us;
    paid_until_us_ = std::max(paid_until_us_, was.time_us) + kEvery_us;
    waiting_[count_] = was;
    waiting_[count_].missed = missed_;
    missed_ = 0;
    ++count_;
  }

  bool empty() const { return count_ == 0; }

  /// Precondition: not empty().
  FaultCircumstances pop() {
    const FaultCircumstances oldest = waiting_[0];
    std::shift_left(waiting_.begin(), waiting_.end(), 1);
    --count_;
    return oldest;
  }

 private:
  std::array<FaultCircumstances, kRoom> waiting_{};
  std::uint64_t paid_until_us_ = 0, last_us_ = 0;
  std::uint16_t missed_ = 0;
  std::uint8_t count_ = 0;
  Fault last_ = Fault::none;
};

}  // namespace astro
