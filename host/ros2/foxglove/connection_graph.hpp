#pragma once

#include <map>
#include <set>
#include <string>

namespace astro::ros2::foxglove {

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

}  // namespace astro::ros2::foxglove
