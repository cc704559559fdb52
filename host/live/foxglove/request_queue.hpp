#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>

#include "host/live/foxglove/requests.hpp"

namespace astro::foxglove {

/// What waits for the robot's thread. Any thread pushes, one takes.
///
/// Bounds  questions: each client has a bounded number of them (Session). Messages: the last 10 of each topic, because only
///         the newest command counts. Notices: 32.
class RequestQueue {
 public:
  static constexpr std::size_t kMostMessages = 10, kMostNotices = 32;

  void push(Request request);
  /// Takes the oldest request of the lowest rank; nothing if that rank is above `last`.
  std::optional<Request> pop(const std::function<int(const Request&)>& rank, int last);
  std::size_t size() const;
  /// Returns when something waits, or at the latest after `timeout`.
  void wait(std::chrono::microseconds timeout);

 private:
  bool make_room(const Request& request);

  mutable std::mutex mutex_;
  std::condition_variable came_;
  std::deque<Request> requests_;
};

}  // namespace astro::foxglove
