#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "host/base/bytes.hpp"
#include "host/truth/source/pose3.hpp"

namespace astro::truth::vrpn {

/// The type by which trackers send poses.
inline constexpr std::string_view kPoseType = "vrpn_Tracker Pos_Quat";

/// One pose of a tracked body. A tracker numbers what it tracks (sensors); those that track rigid bodies give
/// each body a sender of its own and use sensor 0.
struct TrackerPose {
  std::int32_t sensor = 0;
  Pose3 pose;
};

/// Nothing if the payload is no pose: another size than 64 bytes. What is in it may still be no pose that a
/// body can have (is_possible()).
std::optional<TrackerPose> pose_in(ByteView payload);
Bytes payload_of(const TrackerPose& pose);

}  // namespace astro::truth::vrpn
