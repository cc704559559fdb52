#include "host/live/foxglove/client_queue.hpp"

#include "host/live/foxglove/server_messages.hpp"

namespace astro::foxglove {

void ClientQueue::push_control(Frame frame) {
  if (overflowed_) return;
  control_bytes_ += frame.size();
  control_.push_back(std::move(frame));
  if (control_.size() > kMostControl || control_bytes_ > kMostControlBytes) overflowed_ = true;
}

void ClientQueue::push_latched(std::uint32_t subscription, SharedSample sample) {
  std::string head = data_header(subscription, sample->time_ns);
  push_control({false, std::move(head), std::move(sample), subscription});
}

void ClientQueue::push_data(std::uint32_t subscription, SharedSample sample) {
  data_bytes_ += sample->payload.size();
  data_.push_back({subscription, std::move(sample)});
  while (data_.size() > 1 && (data_.size() > kMostData || data_bytes_ > kMostDataBytes)) drop_oldest();
}

void ClientQueue::drop_oldest() {
  data_bytes_ -= data_.front().sample->payload.size();
  data_.pop_front();
  ++dropped_;
}

std::optional<Frame> ClientQueue::pop() {
  if (!control_.empty()) {
    Frame frame = std::move(control_.front());
    control_.pop_front();
    control_bytes_ -= frame.size();
    return frame;
  }
  if (data_.empty()) return std::nullopt;
  Waiting next = std::move(data_.front());
  data_.pop_front();
  data_bytes_ -= next.sample->payload.size();
  std::string head = data_header(next.subscription, next.sample->time_ns);
  return Frame{false, std::move(head), std::move(next.sample), next.subscription};
}

void ClientQueue::forget(std::uint32_t subscription) {
  std::erase_if(control_, [&](const Frame& frame) {
    const bool goes = frame.sample && frame.subscription == subscription;
    if (goes) control_bytes_ -= frame.size();
    return goes;
  });
  std::erase_if(data_, [&](const Waiting& waiting) {
    const bool goes = waiting.subscription == subscription;
    if (goes) data_bytes_ -= waiting.sample->payload.size();
    return goes;
  });
}

}  // namespace astro::foxglove
