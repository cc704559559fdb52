#include "host/truth/trackers/vrpn_tracker.hpp"

#include "host/truth/trackers/big_endian.hpp"

namespace astro::truth::vrpn {

std::optional<TrackerPose> pose_in(ByteView payload) {
  constexpr std::size_t kBytes = 64;
  if (payload.size() != kBytes) return std::nullopt;
  const auto number = [&](std::size_t i) { return load_big<double>(payload, 8 + 8 * i); };
  return TrackerPose{load_big<std::int32_t>(payload, 0),
                     {number(0), number(1), number(2), number(3), number(4), number(5), number(6)}};
}

Bytes payload_of(const TrackerPose& pose) {
  const Pose3& p = pose.pose;
  Bytes payload;
  append_big(payload, pose.sensor);
  append_big(payload, std::int32_t{0});  // a filler, so that the doubles are aligned
  for (const double number : {p.x_m, p.y_m, p.z_m, p.qx, p.qy, p.qz, p.qw}) append_big(payload, number);
  return payload;
}

}  // namespace astro::truth::vrpn
