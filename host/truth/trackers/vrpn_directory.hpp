#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "host/truth/trackers/vrpn_message.hpp"

namespace astro::truth::vrpn {

/// The names that the other side of a connection has given to its ids. Each side chooses its own numbers, so
/// an id means nothing before it was described. A name that is described again gets the newer id.
///
/// Bounds  the first 2000 ids of each kind, as many as the upstream library has.
class Directory {
 public:
  /// True if the message was a description, whether or not its name could be read.
  bool take(const Message& message);

  /// "" for an id that was not described.
  std::string_view sender(std::int32_t id) const { return name_of(senders_, id); }
  std::string_view type(std::int32_t id) const { return name_of(types_, id); }

  /// The senders that may be tracked bodies, in alphabetical order: all but the library's own.
  std::vector<std::string> bodies() const;

 private:
  using Names = std::map<std::int32_t, std::string>;
  static std::string_view name_of(const Names& names, std::int32_t id);

  Names senders_, types_;
};

}  // namespace astro::truth::vrpn
