#include "host/truth/bags/bag_truth.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace astro::truth {
namespace {

double length_of_quaternion(const recording::TimedPose& at) {
  return std::hypot(std::hypot(at.qx, at.qy), std::hypot(at.qz, at.qw));
}

bool is_of_zeros(const recording::TimedPose& at) {
  return at.x_m == 0 && at.y_m == 0 && at.z_m == 0 && length_of_quaternion(at) == 0;
}

/// A publisher of positions has zeros or NaN in all quaternions.
bool has_rotations(const std::vector<recording::TimedPose>& poses) {
  return std::ranges::any_of(poses,
                             [](const recording::TimedPose& at) { return length_of_quaternion(at) > 0; });
}

TrackedPose tracked(const recording::TimedPose& at, bool rotations) {
  TrackedPose out{at.time_ns, {at.x_m, at.y_m, at.z_m, at.qx, at.qy, at.qz, at.qw}, true};
  Pose3& pose = out.pose;
  if (!rotations) pose = {at.x_m, at.y_m, at.z_m, 0, 0, 0, 1};
  out.valid = is_possible(pose) && !is_of_zeros(at);
  if (!out.valid) return out;
  const double length = std::hypot(std::hypot(pose.qx, pose.qy), std::hypot(pose.qz, pose.qw));
  for (double* part : {&pose.qx, &pose.qy, &pose.qz, &pose.qw}) *part /= length;
  return out;
}

}  // namespace

BodyTrack track_in_bag(const std::filesystem::path& path, const recording::PoseSelection& selection) {
  recording::PoseTopic topic = recording::poses_in_bag(path, selection);
  BodyTrack track;
  track.name = topic.stream.child_frame.empty() ? topic.stream.topic : topic.stream.child_frame;
  track.id = topic.stream.name();
  track.facts.format = "ROS 2 bag, " + topic.stream.name() + " of " + topic.stream.type;
  track.facts.length_unit = "m";  // REP 103
  const bool rotations = has_rotations(topic.poses);
  track.facts.rotation_kind = rotations ? RotationKind::quaternion : RotationKind::none;
  track.facts.rotation = rotations ? "quaternion" : "";
  track.facts.remarks = std::move(topic.remarks);
  if (!topic.stream.stamps.most_are_set())
    track.facts.remarks.push_back({"the poses have no stamps; their times are when they were recorded"});
  track.samples.reserve(topic.poses.size());
  for (const recording::TimedPose& pose : topic.poses) track.samples.push_back(tracked(pose, rotations));
  return track;
}

}  // namespace astro::truth
