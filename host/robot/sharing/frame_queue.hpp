#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

namespace astro::robot {

/// Frames that wait to be written to a file descriptor, which may take any number of bytes at a time. Frames
/// enter and leave whole: a frame of which some bytes were written is always finished.
class FrameQueue {
 public:
  /// `withdrawable`: withdraw() drops the frame as long as none of it was written.
  void push(std::span<const std::uint8_t> frame, bool withdrawable = false) {
    insert(frames_.end(), frame, withdrawable);
  }

  /// Puts a frame before all frames of which nothing was written yet.
  void push_first(std::span<const std::uint8_t> frame) {
    insert(begun_ == 0 ? frames_.begin() : frames_.begin() + 1, frame, false);
  }

  /// Drops all frames of which nothing was written yet.
  void drop_waiting() {
    drop_if([](const Frame&) { return true; });
  }
  /// Drops the withdrawable ones among them.
  void withdraw() {
    drop_if([](const Frame& frame) { return frame.withdrawable; });
  }

  /// What is left of the first frame; empty if there is none.
  std::span<const std::uint8_t> front() const {
    return frames_.empty() ? std::span<const std::uint8_t>()
                           : std::span(frames_.front().bytes).subspan(begun_);
  }

  /// Removes `count` bytes of front(), which have been written.
  void taken(std::size_t count) {
    begun_ += count;
    bytes_ -= count;
    if (!frames_.empty() && begun_ == frames_.front().bytes.size()) {
      frames_.pop_front();
      begun_ = 0;
    }
  }

  bool empty() const { return frames_.empty(); }
  std::size_t frames() const { return frames_.size(); }
  /// Bytes that wait.
  std::size_t bytes() const { return bytes_; }

 private:
  struct Frame {
    std::vector<std::uint8_t> bytes;
    bool withdrawable;
  };
  using Frames = std::deque<Frame>;

  void insert(Frames::const_iterator at, std::span<const std::uint8_t> frame, bool withdrawable) {
    frames_.insert(at, Frame{{frame.begin(), frame.end()}, withdrawable});
    bytes_ += frame.size();
  }
  template <class Which>
  void drop_if(const Which& which) {
    const auto waiting = frames_.begin() + (begun_ == 0 ? 0 : 1);
    const auto left = std::remove_if(waiting, frames_.end(), [&](const Frame& frame) {
      if (!which(frame)) return false;
      bytes_ -= frame.bytes.size();
      return true;
    });
    frames_.erase(left, frames_.end());
  }

  Frames frames_;
  std::size_t begun_ = 0;  // bytes of the first frame that have been taken
  std::size_t bytes_ = 0;
};

}  // namespace astro::robot
