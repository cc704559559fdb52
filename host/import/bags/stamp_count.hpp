#pragma once

#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "host/base/error.hpp"

namespace astro::importing {

/// What is odd about the stamps of messages. Values: for `missing` the messages and how many of them, for the
/// others how many seconds; for `begin_again` the file, the messages and after how many seconds.
enum class StampProblem { missing, before_recorder, after_recorder, delays_differ, begin_again };

/// Decides whether the stamps of messages are their times. A publisher that has no clock yet stamps with
/// zero, as all do in simulated time until they receive it. But a clock may also start at zero, and then one
/// message really has this time.
class StampCount {
 public:
  void take(std::int64_t stamp_ns) {
    ++messages_;
    if (stamp_ns == 0) ++zeros_;
    if (stamp_ns != 0 && std::abs(stamp_ns) < least_ns_) least_ns_ = std::abs(stamp_ns);
  }
  /// True if at least half of the messages have a stamp, so that a single one that was set by accident does
  /// not count.
  bool most_are_set() const { return messages_ > 0 && 2 * missing() <= messages_; }
  bool is_missing(std::int64_t stamp_ns) const { return stamp_ns == 0 && missing() > 0; }
  std::uint64_t missing() const {
    constexpr std::int64_t kNearZero_ns = 1'000'000'000;
    return zeros_ == 1 && least_ns_ < kNearZero_ns ? 0 : zeros_;
  }
  /// Adds a remark with the number of messages that were left out, unless it is 0. `what` names them, for
  /// example "poses of /tracker".
  void remark(const std::string& what, std::vector<Remark>& remarks) const {
    if (missing() > 0)
      remarks.push_back({what + ": " + std::to_string(missing()) + " have no stamp and were left out",
                         StampProblem::missing,
                         {what, std::to_string(missing())}});
  }

 private:
  std::uint64_t messages_ = 0, zeros_ = 0;
  std::int64_t least_ns_ = std::numeric_limits<std::int64_t>::max();
};

}  // namespace astro::importing
