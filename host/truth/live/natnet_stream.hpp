#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/truth/live/sighting.hpp"
#include "host/truth/natnet/models.hpp"
#include "host/truth/natnet/packet.hpp"

namespace astro::truth {

/// The poses of one body from the datagrams of a NatNet server. No I/O and no clock.
class NatNetStream {
 public:
  /// `body`: its name in Motive; "": the one that is seen first.
  explicit NatNetStream(std::string body) : body_(std::move(body)) {}

  /// One datagram. What is none of NatNet is ignored.
  void push(ByteView datagram, std::int64_t arrival_us);

  /// Since the last call, oldest first.
  std::vector<Sighting> take() { return sightings_.take(); }

  /// Nothing until the server has answered: frames cannot be understood before.
  const std::optional<natnet::ServerInfo>& server() const { return server_; }
  /// A frame has come whose bodies have no names yet: the models have to be asked for.
  bool needs_names() const { return needs_names_; }

  bool has_frames() const { return frames_; }

  /// Why nothing has come of this body: a clause; "" if something has.
  std::string why_silent() const;
  /// The bodies that are in the frames.
  std::vector<std::string> bodies() const;
  const std::string& body() const { return body_; }

 private:
  void take_frame(ByteView payload, std::int64_t arrival_us);

  std::string body_;
  std::optional<natnet::ServerInfo> server_;
  natnet::BodyNames names_;
  std::vector<std::int32_t> in_frames_;  // ids of the last frame
  bool needs_names_ = false, frames_ = false, seen_ = false;
  Waiting<Sighting> sightings_;
};

}  // namespace astro::truth
