#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "host/truth/live/tracker_link.hpp"

namespace astro::truth {

/// Runs a link on its own thread, so that each pose is stamped when it arrives, however seldom somebody takes poses, and so
/// that the tracker is served while a person is asked something.
///
/// Life     the thread begins in the constructor and ends in the destructor. Only it uses the inner link meanwhile.
/// Calls    from one thread. All that they return is as of the last work(), which throws what the inner link threw.
/// Bounds   if nobody takes poses, some thousand of the newest are kept, and none from before a new connection.
class ListeningLink : public TrackerLink {
 public:
  using Now = std::function<std::chrono::microseconds()>;

  /// `now`: the clock of the arrivals; it is called from the thread.
  ListeningLink(std::unique_ptr<TrackerLink> link, Now now);

  void work(std::chrono::microseconds) override;
  void wait(std::chrono::microseconds timeout) override;
  std::vector<Sighting> take() override { return news_.sightings.take(); }
  std::string why_silent() const override { return news_.why_silent; }
  std::vector<std::string> bodies() const override { return news_.bodies; }
  const std::string& body() const override { return news_.body; }
  std::string way() const override { return news_.way; }
  int connections() const override { return news_.connections; }

 private:
  struct News {
    Waiting<Sighting> sightings;
    std::string why_silent, body, way;
    std::vector<std::string> bodies;
    int connections = 0;

    void add(News later);
  };

  void listen(const std::stop_token& stop);
  News news_of_link();
  void publish(News news);
  void publish(std::exception_ptr failure);

  std::unique_ptr<TrackerLink> link_;
  Now now_;
  News news_;  // as of the last work()
  std::mutex mutex_;
  std::condition_variable changed_;
  News shared_;                 // guarded by the mutex, as the next one
  std::exception_ptr failure_;  // by which the thread has ended
  std::jthread thread_;         // the last member, so that it ends before the others are destroyed
};

}  // namespace astro::truth
