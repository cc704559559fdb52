#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "host/ros2/cdr/codec.hpp"
#include "host/ros2/middleware/middleware.hpp"

namespace astro::ros2 {

/// A topic on several middlewares at once: a message is encoded once for all, and not at all if nobody would get it.
template <Message M>
class Outlet {
 public:
  /// `topic.type` is filled in. Throws astro::Error if a middleware refuses the topic.
  Outlet(std::span<Middleware* const> middlewares, TopicDescription topic) : latched_(topic.latched) {
    topic.type = message_type<M>();
    for (Middleware* each : middlewares) publishers_.push_back(each->advertise(topic));
  }

  /// A latched topic always is: somebody may subscribe later.
  bool wanted() const {
    return latched_ || std::any_of(publishers_.begin(), publishers_.end(),
                                   [](const auto& each) { return each->has_subscribers(); });
  }

  void publish(const M& message, std::int64_t time_ns) {
    if (!wanted()) return;
    const Bytes bytes = encode(message);
    for (const auto& each : publishers_) each->publish(bytes, time_ns);
  }

 private:
  std::vector<std::unique_ptr<Publisher>> publishers_;
  bool latched_;
};

}  // namespace astro::ros2
