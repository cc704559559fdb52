#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "host/truth/source/pose3.hpp"

namespace astro::truth {

/// Where a tracker sends, and which of its bodies is the robot:
///
///   vrpn://HOST[:PORT][/BODY][?up=y]
///   natnet://HOST[:PORT][/BODY][?up=y]
///
/// A character that has a meaning here is written as %XX in the body's name. An IPv6 address stands in
/// brackets.
struct TrackerUrl {
  std::string scheme, host;
  std::uint16_t port = 0;  // 0: the protocol's own
  std::string body;        // "": the only one
  UpAxis up = UpAxis::z;

  /// The same, with the protocol's own port where none is named.
  TrackerUrl with_usual_port(std::uint16_t usual) const;
  /// "lab-pc:3883"
  std::string place() const;
};

/// Whether the text is meant as the address of a tracker.
bool is_tracker_url(std::string_view text);

/// Throws astro::Error, which names the part that is wrong.
TrackerUrl tracker_url_in(std::string_view text);

}  // namespace astro::truth
