#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

/// Which other computers a participant looks for, and is seen by.
namespace astro::dds {

/// What is wrong with an environment variable. Values: of unknown_value its name and what it is, of
/// peer_without_address the peer.
enum class DiscoveryProblem { unknown_value, peer_without_address };

enum class Range {
  off,        // nobody, not even on this computer
  localhost,  // this computer
  subnet      // whoever multicast reaches, and the static peers
};

struct Discovery {
  int domain = 0;
  Range range = Range::localhost;
  /// Further hosts on which others are looked for, unless the range is off: names or IPv4 addresses. If there are any,
  /// datagrams of all networks of this computer are accepted.
  std::vector<std::string> peers{};
};

inline constexpr int kMostDomains = 232;  // the ports of a higher one would pass 65535

/// Explicit choices. What has no value here is taken from the environment.
struct DiscoveryWishes {
  std::optional<int> domain;
  std::optional<Range> range;
};

/// Reads ROS_DOMAIN_ID, ROS_AUTOMATIC_DISCOVERY_RANGE, ROS_STATIC_PEERS and ROS_LOCALHOST_ONLY as ROS 2 does. The last one
/// overrides the range, and then there are no peers either. Unlike in ROS 2, the default range is this computer. A wish
/// overrides all variables. `variable` returns "" for a variable that is not set.
///
/// Throws astro::Error naming the variable for a value that ROS 2 does not know.
/// Source  rcl: init.c, discovery_options.c.
Discovery discovery_from(const DiscoveryWishes& wishes,
                         const std::function<std::string(const char*)>& variable);

/// "off", "localhost", "subnet", in any case of letters; nothing for another text.
std::optional<Range> range_in(std::string text);

}  // namespace astro::dds
