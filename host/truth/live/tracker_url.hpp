#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "host/live/dds/discovery.hpp"
#include "host/truth/source/pose3.hpp"

namespace astro::truth {

/// What is wrong with the address of a tracker. Values: the address, and the part that is wrong if there is
/// one.
enum class UrlProblem {
  scheme_unknown,
  left_over,
  topic_on_host,
  topic_malformed,
  option_unknown,
  option_twice,
  bracket_open,
  no_host,
  port_impossible,
  up_axis_unknown,
  escape_malformed
};

/// Where a tracker sends, and which of its bodies is the robot:
///
///   vrpn://HOST[:PORT][/BODY][?up=y]
///   natnet://HOST[:PORT][/BODY][?up=y]
///   ros2:/TOPIC[?child=FRAME][&parent=FRAME][&up=y][&domain=N][&range=subnet]
///
/// A character that has a meaning here is written as %XX in the names of bodies and frames. An IPv6 address stands in
/// brackets. A topic of ROS 2 has no host. Which node publishes it, and where, ROS 2 finds out by itself: in the domain and
/// on the computers that the environment names, unless the address names others (host/live/dds/discovery.hpp).
struct TrackerUrl {
  std::string scheme, host;
  std::uint16_t port = 0;  // 0: the protocol's own
  std::string body;        // "": the only one; in ROS 2 its frame
  UpAxis up = UpAxis::z;
  std::string topic, parent;  // of ROS 2 alone; the parent is the tracker's frame, "": that of the messages
  dds::DiscoveryWishes where{};  // of ROS 2 alone

  /// The same, with the protocol's own port where none is named.
  TrackerUrl with_usual_port(std::uint16_t usual) const;
  /// "lab-pc:3883"; "ROS 2"
  std::string place() const;
};

/// Whether the text is meant as the address of a tracker.
bool is_tracker_url(std::string_view text);

/// Throws astro::Error, which names the part that is wrong.
TrackerUrl tracker_url_in(std::string_view text);

}  // namespace astro::truth
