#include "host/truth/live/listening_link.hpp"

#include "host/base/blocked_signals.hpp"

namespace astro::truth {

using std::chrono::microseconds;
using std::chrono::milliseconds;

namespace {

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
  News news{{}, link_->why_silent(), link_->body(), link_->way(), link_->bodies(), link_->connections()};
  for (const Sighting& sighting : link_->take()) news.sightings.push(sighting);
  return news;
}

void ListeningLink::publish(News news) {
  const bool poses = !news.sightings.all().empty();
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
  Waiting<Sighting> all = later.connections == connections ? std::move(sightings) : Waiting<Sighting>();
  for (const Sighting& sighting : later.sightings.all()) all.push(sighting);
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
  changed_.wait_for(lock, timeout, [this] { return !shared_.sightings.all().empty() || failure_; });
}

}  // namespace astro::truth
