#pragma once

#include <cstdint>

namespace astro {

/// Counts ticks and proves their rate: a gap of more than two periods is an overrun.
class TickClock {
 public:
  /// At the start of a tick. True if it came too late.
  bool advance(std::uint64_t now_us) {
    const bool late = count_ != 0 && now_us - last_us_ > 2 * kPeriod_us;
    last_us_ = now_us;
    ++count_;
    overruns_ += late ? 1 : 0;
    return late;
  }
  std::uint32_t count() const { return count_; }
  std::uint32_t overruns() const { return overruns_; }
  std::uint64_t last_us() const { return last_us_; }

 private:
  static constexpr std::uint64_t kPeriod_us = 1000;
  std::uint64_t last_us_ = 0;
  std::uint32_t count_ = 0;
  std::uint32_t overruns_ = 0;
};

}  // namespace astro
