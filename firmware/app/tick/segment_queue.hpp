#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/control/segment.hpp"

namespace astro {

/// A ring of at most N values.
template <class T, std::size_t N>
class Ring {
 public:
  bool full() const { return size_ == N; }
  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  void clear() { size_ = 0; }

  /// Drops the value if the ring is full. Ask full() first where that matters.
  void push(const T& value) {
    if (full()) return;
    slots_[wrapped(first_ + size_)] = value;
    ++size_;
  }
  /// Puts the value before all others. Drops it if the ring is full.
  void push_front(const T& value) {
    if (full()) return;
    first_ = wrapped(first_ + N - 1);
    slots_[first_] = value;
    ++size_;
  }
  /// Precondition: not empty.
  const T& front() const { return slots_[first_]; }
  T pop() {
    const T value = slots_[first_];
    first_ = wrapped(first_ + 1);
    --size_;
    return value;
  }
  /// Appends `make(value)` for each value of `from`, the oldest first, as far as there is room; empties
  /// `from`.
  template <class U, std::size_t M, class Make>
  void push_all(Ring<U, M>& from, Make&& make) {
    std::size_t to = wrapped(first_ + size_), at = from.first_;
    const std::size_t count = from.size_ < N - size_ ? from.size_ : N - size_;
    for (std::size_t left = count; left != 0; --left) {
      slots_[to] = make(from.slots_[at]);
      to = wrapped(to + 1);
      at = from.wrapped(at + 1);
    }
    size_ += count;
    from.clear();
  }

 private:
  template <class U, std::size_t M>
  friend class Ring;
  // Cheaper than a remainder, which matters because a full queue is emptied while the tick is held.
  static std::size_t wrapped(std::size_t place) { return place < N ? place : place - N; }

  std::array<T, N> slots_{};
  std::size_t first_ = 0;
  std::size_t size_ = 0;
};

struct QueuedSegment {
  Segment segment;
  std::uint16_t tag = 0;
};

struct SegmentEvent {
  enum class Kind : std::uint8_t { started, completed, aborted };
  std::uint64_t time_us = 0;
  std::uint16_t tag = 0;
  Kind kind = Kind::started;
};

/// Hosts may queue so many segments; one more place is for the rest of a segment that a pause puts back.
inline constexpr std::size_t kQueueLength = 16;
using SegmentQueue = Ring<QueuedSegment, kQueueLength + 1>;
/// Room for the ends of a full queue and of the segment under way, so that none is lost between two turns of
/// the main loop.
inline constexpr std::size_t kEventsLength = 2 * kQueueLength + 4;
using SegmentEvents = Ring<SegmentEvent, kEventsLength>;

}  // namespace astro
