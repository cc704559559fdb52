#pragma once

#include <algorithm>
#include <optional>

#include "host/base/microseconds.hpp"

namespace astro::page {

/// Keeps a clock that passes only on request, as a simulated robot's, in step with the clock on the wall. What the wall's clock
/// has gained beyond kMostLag, as in a browser's tab that was hidden, is not made up for, nor what the robot's has gained, as in a
/// measurement that it drove at once.
class RealTime {
 public:
  static constexpr microseconds kMostLag = std::chrono::milliseconds(250);

  /// How long the robot's clock has to run now; zero if it is ahead, because requests let its time pass, too.
  microseconds due(microseconds wall, microseconds robot) {
    if (!behind_) behind_ = wall - robot;
    const microseconds lag = wall - robot - *behind_;
    if (lag > kMostLag) *behind_ += lag - kMostLag;
    if (lag < -kMostLag) *behind_ += lag;
    return std::clamp(lag, microseconds::zero(), kMostLag);
  }

 private:
  std::optional<microseconds> behind_;  // the offset between the clocks
};

}  // namespace astro::page
