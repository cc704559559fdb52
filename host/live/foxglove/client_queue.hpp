#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "host/live/foxglove/catalogue.hpp"
#include "host/live/foxglove/server_messages.hpp"
#include "host/live/web/frame_queue.hpp"

namespace astro::foxglove {

/// What waits to be sent to one client: answers and lists as texts, messages of topics with what the protocol puts before them.
class ClientQueue : public web::FrameQueue {
 public:
  void push_text(std::string text) { push_control({true, std::move(text), nullptr, 0}); }
  void push_binary(std::string bytes) { push_control({false, std::move(bytes), nullptr, 0}); }
  /// Queues a sample of a latched topic, as a control message.
  void push_latched(std::uint32_t subscription, SharedSample sample) {
    push_control(frame_of(subscription, std::move(sample)));
  }
  void push_data(std::uint32_t subscription, SharedSample sample) {
    FrameQueue::push_data(frame_of(subscription, std::move(sample)));
  }

 private:
  static web::Frame frame_of(std::uint32_t subscription, SharedSample sample) {
    std::string head = data_header(subscription, sample->time_ns);
    return {false, std::move(head), std::move(sample), subscription};
  }
};

}  // namespace astro::foxglove
