#include "host/live/web/frame_queue.hpp"

#include <utility>

namespace astro::web {
namespace {

/// Takes the oldest frame.
Frame take_first(std::deque<Frame>& frames, std::size_t& bytes) {
  Frame first = std::move(frames.front());
  frames.pop_front();
  bytes -= first.size();
  return first;
}

void forget_in(std::deque<Frame>& frames, std::size_t& bytes, std::uint32_t subscription) {
  std::erase_if(frames, [&](const Frame& frame) {
    const bool goes = frame.sample && frame.subscription == subscription;
    if (goes) bytes -= frame.size();
    return goes;
  });
}

}  // namespace

void FrameQueue::push_control(Frame frame) {
  if (overflowed_) return;
  control_bytes_ += frame.size();
  control_.push_back(std::move(frame));
  if (control_.size() > kMostControl || control_bytes_ > kMostControlBytes) overflowed_ = true;
}

void FrameQueue::push_data(Frame frame) {
  data_bytes_ += frame.size();
  data_.push_back(std::move(frame));
  while (data_.size() > 1 && (data_.size() > kMostData || data_bytes_ > kMostDataBytes)) drop_oldest();
}

void FrameQueue::drop_oldest() {
  take_first(data_, data_bytes_);
  ++dropped_;
}

std::optional<Frame> FrameQueue::pop() {
  if (!control_.empty()) return take_first(control_, control_bytes_);
  if (!data_.empty()) return take_first(data_, data_bytes_);
  return std::nullopt;
}

void FrameQueue::forget(std::uint32_t subscription) {
  forget_in(control_, control_bytes_, subscription);
  forget_in(data_, data_bytes_, subscription);
}

}  // namespace astro::web
