#pragma once

#include <cstdint>

namespace astro {

/// Counts ticks and checks their rate against the board's clock. A tick is not on time if the gap before it
/// is more than half a period too long or too short. A thousand ticks are not on time if together they take
/// more than a thousandth longer or shorter than a second.
class TickClock {
 public:
  static constexpr std::uint32_t kPeriod_us = 1000;
  static constexpr std::uint32_t kMost_us = kPeriod_us + kPeriod_us / 2;
  static constexpr std::uint32_t kLeast_us = kPeriod_us / 2;

  /// Called at the start of a tick. False if the tick, or the thousand that it ends, is not on time.
  bool advance(std::uint64_t now_us) {
    const auto gap_us = static_cast<std::uint32_t>(now_us - last_us_);
    last_us_ = now_us;
    if (count_++ == 0) {
      window_us_ = now_us;
      return true;
    }
    bool on_time = gap_us - kLeast_us <= kMost_us - kLeast_us;
    if (gap_us > longest_us_) longest_us_ = gap_us;
    if (!on_time) {  // reported now, so it must not be reported again at the end of its thousand
      window_us_ = now_us;
      window_ticks_ = 0;
    } else if (++window_ticks_ == kWindow) {
      on_time = now_us - window_us_ - kWindow * (kPeriod_us - 1) <= 2 * kWindow;
      window_us_ = now_us;
      window_ticks_ = 0;
    }
    overruns_ += on_time ? 0 : 1;
    return on_time;
  }
  std::uint32_t count() const { return count_; }
  std::uint32_t overruns() const { return overruns_; }
  std::uint32_t longest_us() const { return longest_us_; }  // between two ticks, since start
  std::uint64_t last_us() const { return last_us_; }

 private:
  static constexpr std::uint32_t kWindow = 1000;

  std::uint64_t last_us_ = 0, window_us_ = 0;
  std::uint32_t count_ = 0, window_ticks_ = 0;
  std::uint32_t overruns_ = 0;
  std::uint32_t longest_us_ = 0;
};

}  // namespace astro
