#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/control/trapezoid.hpp"
#include "common/protocol/enums.hpp"

namespace astro {

/// A ring of at most N values.
template <class T, std::size_t N>
class Ring {
 public:
  bool full() const { return size_ == N; }
  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  void clear() { size_ = 0; }

  /// Drops the value when full: look at full() first where that matters.
  void push(const T& value) {
    if (full()) return;
    slots_[(first_ + size_) % N] = value;
    ++size_;
  }
  /// Only when not empty.
  T pop() {
    const T value = slots_[first_];
    first_ = (first_ + 1) % N;
    --size_;
    return value;
  }

 private:
  std::array<T, N> slots_{};
  std::size_t first_ = 0;
  std::size_t size_ = 0;
};

struct QueuedSegment {
  Trapezoid profile;
  std::uint16_t tag = 0;
};

struct SegmentEvent {
  std::uint16_t tag = 0;
  protocol::SegmentOutcome outcome = protocol::SegmentOutcome::completed;
  std::uint64_t time_us = 0;
};

inline constexpr std::size_t kQueueLength = 16;
using SegmentQueue = Ring<QueuedSegment, kQueueLength>;
/// Room for the ends of a whole queue and the segment that runs, so that no end is lost between two main
/// loops.
using SegmentEvents = Ring<SegmentEvent, 2 * kQueueLength>;

}  // namespace astro
