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
  /// Hosts that are asked as well, whatever the range: names or IPv4 addresses. With any of them this computer hears all of its
  /// networks.
  std::vector<std::string> peers{};
};

inline constexpr int kMostDomains = 232;  // the ports of a higher one would pass 65535

/// What somebody asks for; what is not asked for is taken from the environment.
struct DiscoveryWishes {
  std::optional<int> domain;
  std::optional<Range> range;
};

/// As ROS 2 reads ROS_DOMAIN_ID, ROS_AUTOMATIC_DISCOVERY_RANGE, ROS_STATIC_PEERS and ROS_LOCALHOST_ONLY, of which the last one
/// wins: with it there are no peers either. But where nothing is said, the range is this computer. A wish wins over all of
/// them. `variable` returns "" for one that is not set.
///
/// Throws astro::Error naming the variable for a value that ROS 2 does not know.
/// Source  rcl: init.c, discovery_options.c.
Discovery discovery_from(const DiscoveryWishes& wishes,
                         const std::function<std::string(const char*)>& variable);

/// "off", "localhost", "subnet", in any case of letters; nothing for another text.
std::optional<Range> range_in(std::string text);

}  // namespace astro::dds
