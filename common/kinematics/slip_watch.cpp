#include "common/kinematics/slip_watch.hpp"

#include <algorithm>

#include "common/fixed/saturate.hpp"

namespace astro {
namespace {

constexpr std::int64_t kLeast_32 = (std::int64_t{1} << 32) / 600;  // 0.6 degrees
constexpr std::int64_t kMost_32 = std::int64_t{1} << 31;  // beyond half a turn a square would overflow
constexpr std::int64_t kFourSigma2 = 121;                 // 4 x 5.5^2

}  // namespace

void SlipWatch::Window::replace(const Entry& oldest, const Entry& newest) {
  innovation += std::int64_t{newest.innovation_32} - oldest.innovation_32;
  turn += std::int64_t{newest.wheels_32} - oldest.wheels_32;
  path += std::int64_t{newest.path_20} - oldest.path_20;
}

void SlipWatch::reset() {
  ring_ = {};
  short_ = long_ = {};
  calm_ = kWindow;
}

bool SlipWatch::advance(const HeadingStep& step, const HeadingFilter& filter) {
  const Entry newest{saturate32(filter.innovation_48() >> 16), step.wheels_32, step.path_20};
  const auto long_ago = static_cast<std::size_t>(at_);
  const Entry before_long = ring_[long_ago];
  const Entry before_short = ring_[(long_ago + kWindow - kShort) % kWindow];
  ring_[long_ago] = newest;
  at_ = at_ + 1 < kWindow ? at_ + 1 : 0;
  long_.replace(before_long, newest);
  short_.replace(before_short, newest);
  const auto change_since = [&](const Entry& then) {
    return std::int64_t{newest.wheels_32} - then.wheels_32;
  };
  const bool slips = exceeds_noise(short_, kShort, change_since(before_short), filter) ||
                     exceeds_noise(long_, kWindow, change_since(before_long), filter);
  const bool fresh = slips && !slipping();
  calm_ = slips ? 0 : std::min(calm_ + 1, kWindow);
  return fresh;
}

bool SlipWatch::exceeds_noise(const Window& window, int steps, std::int64_t change,
                              const HeadingFilter& filter) const {
  const std::int64_t sum = std::min(magnitude(window.innovation), kMost_32);
  if (sum < kLeast_32) return false;
  constexpr std::int64_t kMostTurn = std::int64_t{1} << 40;
  const std::int64_t turn = std::min(magnitude(window.turn), kMostTurn) / 1024;
  // A step is 10 ms. A quotient of 32 bits, because one of 64 is ten times as dear.
  const std::int64_t change_in_2ms = static_cast<std::uint32_t>(std::min(magnitude(change), kMost_32)) / 5;
  const std::int64_t variance = steps * HeadingFilter::kGyro + filter.slip(window.path) + rounding_ +
                                steps * steps * filter.bias_variance() + change_in_2ms * change_in_2ms +
                                turn * turn;
  constexpr std::int64_t kMostVariance = std::int64_t{1} << 57;  // 121 / 4 of it fit into 63 bits
  return sum * sum > kFourSigma2 * (std::min(variance, kMostVariance) / 4);
}

}  // namespace astro
