#include "host/live/foxglove/request_queue.hpp"

#include <algorithm>

namespace astro::foxglove {

void RequestQueue::push(Request request) {
  {
    const std::lock_guard lock(mutex_);
    if (!make_room(request)) return;
    requests_.push_back(std::move(request));
  }
  came_.notify_one();
}

/// Removes the oldest message of the same topic if there are too many. False: the request is left out.
bool RequestQueue::make_room(const Request& request) {
  if (std::holds_alternative<NoticeArrived>(request))
    return static_cast<std::size_t>(
               std::count_if(requests_.begin(), requests_.end(), [](const Request& each) {
                 return std::holds_alternative<NoticeArrived>(each);
               })) < kMostNotices;
  const auto* message = std::get_if<MessageArrived>(&request);
  if (message == nullptr) return true;
  const auto is_same = [&](const Request& each) {
    const auto* other = std::get_if<MessageArrived>(&each);
    return other != nullptr && other->inlet == message->inlet;
  };
  if (static_cast<std::size_t>(std::count_if(requests_.begin(), requests_.end(), is_same)) >= kMostMessages)
    requests_.erase(std::find_if(requests_.begin(), requests_.end(), is_same));
  return true;
}

std::optional<Request> RequestQueue::pop(const std::function<int(const Request&)>& rank, int last) {
  const std::lock_guard lock(mutex_);
  const auto taken = std::min_element(requests_.begin(), requests_.end(),
                                      [&](const Request& a, const Request& b) { return rank(a) < rank(b); });
  if (taken == requests_.end() || rank(*taken) > last) return std::nullopt;
  Request next = std::move(*taken);
  requests_.erase(taken);
  return next;
}

std::size_t RequestQueue::size() const {
  const std::lock_guard lock(mutex_);
  return requests_.size();
}

void RequestQueue::wait(std::chrono::microseconds timeout) {
  std::unique_lock lock(mutex_);
  came_.wait_for(lock, timeout, [this] { return !requests_.empty(); });
}

}  // namespace astro::foxglove
