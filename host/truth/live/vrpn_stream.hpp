#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "host/truth/live/sighting.hpp"
#include "host/truth/trackers/vrpn_directory.hpp"
#include "host/truth/trackers/vrpn_reader.hpp"

namespace astro::truth {

/// The poses of one body from the bytes of a VRPN server. No I/O and no clock.
class VrpnStream {
 public:
  /// `body`: its name at the tracker; "": the one that sends first.
  explicit VrpnStream(std::string body) : body_(std::move(body)) {}

  /// Throws astro::Error, a clause that says what is wrong, if the other side does not speak VRPN.
  void push(ByteView bytes, std::int64_t arrival_us);

  /// The poses since the last call, oldest first.
  std::vector<Sighting> take() { return sightings_.take(); }

  /// Why nothing has come of this body although the connection stands: a clause; "" if something has. Lists
  /// the bodies that the server has described, because a name that it does not know is no error to it.
  std::string why_silent() const;
  /// The bodies that have sent poses, some hundred at most. More than one is ambiguous if no name was given.
  std::vector<std::string> senders() const { return {senders_.begin(), senders_.end()}; }
  const std::string& body() const { return body_; }

 private:
  void take_pose(const vrpn::Message& message, std::int64_t arrival_us);

  std::string body_;
  vrpn::StreamReader reader_;
  vrpn::Directory directory_;
  std::set<std::string, std::less<>> senders_;
  bool seen_ = false;  // a pose of the body has come
  Waiting<Sighting> sightings_;
};

}  // namespace astro::truth
