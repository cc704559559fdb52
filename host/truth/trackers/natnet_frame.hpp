#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "host/truth/source/pose3.hpp"
#include "host/truth/trackers/natnet_packet.hpp"

namespace astro::truth::natnet {

struct RigidBody {
  std::int32_t id = 0;  // its name is in the models
  Pose3 pose;
  bool tracked = false;

  bool operator==(const RigidBody&) const = default;
};

/// What this project needs of a frame.
struct Frame {
  std::int32_t number = 0;
  std::vector<RigidBody> bodies;
  double timestamp_s = 0;  // since the server's start
  // The server's clock: middle of the exposure (0 for cameras that cannot tell it), arrival of the pictures,
  // and sending.
  std::uint64_t exposed_ticks = 0, received_ticks = 0, sent_ticks = 0;
  bool models_changed = false;  // names and ids have to be asked for again

  bool operator==(const Frame&) const = default;
};

/// Nothing if the payload is no frame of this version. In versions newer than 4.1 there may be unknown
/// sections between the known ones and the times at the end, which are skipped.
std::optional<Frame> frame_in(ByteView payload, Version version);
/// A frame with nothing but these bodies.
Bytes payload_of(const Frame& frame, Version version);

/// When the cameras exposed, in microseconds of the server's clock; by the best time that the frame has.
std::int64_t exposed_us(const Frame& frame, std::uint64_t ticks_per_s);

}  // namespace astro::truth::natnet
