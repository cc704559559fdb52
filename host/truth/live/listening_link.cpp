#include "host/truth/live/listening_link.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>

#include "host/base/blocked_signals.hpp"

namespace astro::truth {

using std::chrono::microseconds;
using std::chrono::milliseconds;

namespace {

constexpr std::size_t kMostKept = 4096;
constexpr microseconds kTurn =
    milliseconds(20);  // between two looks at what is due, and until the thread can end

}  // namespace

ListeningLink::ListeningLink(std::unique_ptr<TrackerLink> link, Now now)
    : link_(std::move(link)), now_(std::move(now)) {
  const BlockedSignals blocked;
  thread_ = std::jthread([this](const std::stop_token& stop) { listen(stop); });
}

void ListeningLink::listen(const std::stop_token& stop) {
  try {
    while (!stop.stop_requested()) {
      link_->work(now_());
      publish(news_of_link());
      link_->wait(kTurn);
    }
  } catch (...) {
    publish(std::current_exception());
  }
}

ListeningLink::News ListeningLink::news_of_link() {
  return {link_->take(),   link_->why_silent(), link_->body(),       link_->way(),
          link_->remedy(), link_->bodies(),     link_->connections()};
}

void ListeningLink::publish(News news) {
  const bool poses = !news.sightings.empty();
  {
    const std::lock_guard lock(mutex_);
    shared_.add(std::move(news));
  }
  if (poses) changed_.notify_one();
}

void ListeningLink::publish(std::exception_ptr failure) {
  {
    const std::lock_guard lock(mutex_);
    failure_ = std::move(failure);
  }
  changed_.notify_one();
}

void ListeningLink::News::add(News later) {
  std::vector<Sighting> all =
      later.connections == connections ? std::move(sightings) : std::vector<Sighting>();
  all.insert(all.end(), later.sightings.begin(), later.sightings.end());
  if (all.size() > 2 * kMostKept) all.erase(all.begin(), all.end() - static_cast<std::ptrdiff_t>(kMostKept));
  *this = std::move(later);
  sightings = std::move(all);
}

void ListeningLink::work(microseconds) {
  const std::lock_guard lock(mutex_);
  if (failure_) std::rethrow_exception(failure_);
  news_.add(shared_);
  shared_.sightings.clear();
}

void ListeningLink::wait(microseconds timeout) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, timeout, [this] { return !shared_.sightings.empty() || failure_; });
}

}  // namespace astro::truth
