#include "host/truth/bags/bag_truth.hpp"

#include <cmath>
#include <utility>

namespace astro::truth {
namespace {

TrackedPose tracked(const recording::TimedPose& at) {
  TrackedPose out{at.time_ns, {at.x_m, at.y_m, at.z_m, at.qx, at.qy, at.qz, at.qw}, true};
  Pose3& pose = out.pose;
  out.valid = is_possible(pose);
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
  track.facts.rotation_kind = RotationKind::quaternion;
  track.facts.rotation = "quaternion";
  track.facts.remarks = std::move(topic.remarks);
  if (!topic.stream.stamps.most_are_set())
    track.facts.remarks.push_back({"the poses have no stamps; their times are when they were recorded"});
  track.samples.reserve(topic.poses.size());
  for (const recording::TimedPose& pose : topic.poses) track.samples.push_back(tracked(pose));
  return track;
}

}  // namespace astro::truth
