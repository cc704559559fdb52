#include "host/import/drives/bag_truth.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "host/formats/files/bag_files.hpp"

namespace astro::importing {
namespace {

double length_of_quaternion(const TimedPose& at) {
  return std::hypot(std::hypot(at.qx, at.qy), std::hypot(at.qz, at.qw));
}

bool is_of_zeros(const TimedPose& at) {
  return at.x_m == 0 && at.y_m == 0 && at.z_m == 0 && length_of_quaternion(at) == 0;
}

/// Whether any pose has a rotation. A publisher of positions has zeros or NaN in all quaternions.
bool has_rotations(const std::vector<TimedPose>& poses) {
  return std::ranges::any_of(poses, [](const TimedPose& at) { return length_of_quaternion(at) > 0; });
}

truth::TrackedPose tracked(const TimedPose& at, bool rotations) {
  truth::TrackedPose out{at.time_ns, {at.x_m, at.y_m, at.z_m, at.qx, at.qy, at.qz, at.qw}, true};
  truth::Pose3& pose = out.pose;
  if (!rotations) pose = {at.x_m, at.y_m, at.z_m, 0, 0, 0, 1};
  out.valid = truth::is_possible(pose) && !is_of_zeros(at);
  if (!out.valid) return out;
  const double length = std::hypot(std::hypot(pose.qx, pose.qy), std::hypot(pose.qz, pose.qw));
  for (double* part : {&pose.qx, &pose.qy, &pose.qz, &pose.qw}) *part /= length;
  return out;
}

}  // namespace

truth::BodyTrack track_in_bag(const std::filesystem::path& path, const PoseSelection& selection) {
  PoseTopic topic = poses_in_bag(path, selection);
  truth::BodyTrack track;
  track.name = topic.stream.child_frame.empty() ? topic.stream.topic : topic.stream.child_frame;
  track.id = topic.stream.name();
  track.facts.format = (bag::is_ros1_bag(path) ? "ROS 1 bag, " : "ROS 2 bag, ") + topic.stream.name() +
                       " of " + topic.stream.type;
  track.facts.length_unit = "m";  // REP 103
  const bool rotations = has_rotations(topic.poses);
  track.facts.rotation_kind = rotations ? truth::RotationKind::quaternion : truth::RotationKind::none;
  track.facts.rotation = rotations ? "quaternion" : "";
  track.facts.remarks = std::move(topic.remarks);
  if (!topic.stream.stamps.most_are_set())
    track.facts.remarks.push_back({"the poses have no stamps; their times are when they were recorded"});
  track.samples.reserve(topic.poses.size());
  for (const TimedPose& pose : topic.poses) track.samples.push_back(tracked(pose, rotations));
  return track;
}

}  // namespace astro::importing
