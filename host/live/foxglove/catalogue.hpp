#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "host/live/driver/middleware.hpp"
#include "host/live/web/frame_queue.hpp"

/// What a server offers to all its clients, and who is there. Ids count from 1 in the order in which things were added.
namespace astro::foxglove {

// One message of one channel; all clients share it.
using web::Sample;
using web::SharedSample;

/// A topic that the robot publishes.
struct Channel {
  std::uint32_t id = 0;
  live::TopicDescription topic;
  std::deque<SharedSample> kept;                  // latched: the last `depth`
  std::shared_ptr<std::atomic<int>> subscribers;  // read by the publisher, in another thread
};

/// A topic that clients may publish.
struct Inlet {
  std::uint32_t id = 0;
  live::TopicDescription topic;
};

struct Service {
  std::uint32_t id = 0;
  live::ServiceDescription service;
};

struct Catalogue {
  std::string name;        // of the server, for people
  std::string session_id;  // another one after each start, so that a client knows that ids have changed
  std::vector<Channel> channels;
  std::vector<Inlet> inlets;
  std::vector<Service> services;
  bool takes_messages = false;  // whether clients may publish
  bool has_parameters = false;
};

/// The element with this id, or nullptr.
template <class T>
auto* find(T& list, std::uint32_t id) {
  return id == 0 || id > list.size() ? nullptr : &list[id - 1];
}

/// Who publishes, subscribes and serves what, by name.
struct ConnectionGraph {
  using Ends =
      std::map<std::string, std::set<std::string>>;  // the name of a topic or a service, and who is there

  Ends published, subscribed, services;

  /// All topics that somebody publishes or subscribes.
  std::set<std::string> topics() const {
    std::set<std::string> names;
    for (const Ends* ends : {&published, &subscribed})
      for (const auto& [name, who] : *ends) names.insert(name);
    return names;
  }
  bool operator==(const ConnectionGraph&) const = default;
};

}  // namespace astro::foxglove
