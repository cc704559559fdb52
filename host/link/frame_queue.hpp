#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

namespace astro::link {

/// Frames that wait to be written to a file descriptor that takes as many bytes as it likes. Only whole
/// frames enter and leave: one that has begun is always finished.
class FrameQueue {
 public:
  void push(std::span<const std::uint8_t> frame) { insert(frames_.end(), frame); }

  /// Before all frames that have not begun.
  void push_first(std::span<const std::uint8_t> frame) {
    insert(begun_ == 0 ? frames_.begin() : frames_.begin() + 1, frame);
  }

  /// Drops all frames that have not begun.
  void drop_waiting() {
    while (frames_.size() > (begun_ == 0 ? 0U : 1U)) {
      bytes_ -= frames_.back().size();
      frames_.pop_back();
    }
  }

  /// What is left of the first frame; empty if there is none.
  std::span<const std::uint8_t> front() const {
    return frames_.empty() ? std::span<const std::uint8_t>() : std::span(frames_.front()).subspan(begun_);
  }

  /// So many bytes of front() have been written.
  void taken(std::size_t count) {
    begun_ += count;
    bytes_ -= count;
    if (!frames_.empty() && begun_ == frames_.front().size()) {
      frames_.pop_front();
      begun_ = 0;
    }
  }

  bool empty() const { return frames_.empty(); }
  std::size_t frames() const { return frames_.size(); }
  /// Not yet taken.
  std::size_t bytes() const { return bytes_; }

 private:
  using Frames = std::deque<std::vector<std::uint8_t>>;
  void insert(Frames::const_iterator at, std::span<const std::uint8_t> frame) {
    frames_.emplace(at, frame.begin(), frame.end());
    bytes_ += frame.size();
  }

  Frames frames_;
  std::size_t begun_ = 0;  // bytes of the first frame that have been taken
  std::size_t bytes_ = 0;
};

}  // namespace astro::link
