#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/formats/messages/stamped_pose.hpp"
#include "host/truth/trackers/frame_tree.hpp"

namespace astro::truth {

/// The poses are no ground truth: they are in the frame of odometry, or by way of it. Values: the topic and
/// the frame.
enum class PoseProblem { in_odometry_frame, by_odometry_frame };

/// Which poses of a topic are the robot's. Frames that are "" are those of the messages, if there is only one body.
struct RosBody {
  std::string topic;   // "/vrpn_mocap/robot/pose", "/tf"
  std::string parent;  // the frame in which the tracker measures: "world"
  std::string child;   // the tracked frame: "robot"
};

/// A pose with header.stamp: the publisher's clock, 0 if it did not set one.
struct RosPose {
  std::int64_t time_ns = 0;
  Pose3 pose;
};

/// The poses of one body from messages of ROS 2. No I/O and no clock.
///
/// What the robot itself computes is no ground truth, so poses in a frame whose name says odometry (REP 105: "odom") are
/// refused, also where they are only a part of a chain of transforms.
class RosPoseStream {
 public:
  explicit RosPoseStream(RosBody wanted);

  /// Takes a message of the topic. Precondition: ros2::holds_poses(type). Bytes that are no such message, or in which the
  /// name of a frame is too long, are only counted. Throws astro::Error if its poses are no ground truth.
  void push(std::string_view type, ByteView message);
  /// Takes a message of /tf_static.
  void push_fixed(ByteView message);

  /// The poses since the last call, oldest first.
  std::vector<RosPose> take() { return std::exchange(poses_, {}); }

  /// Why nothing has come of this body: a clause; "" if something has.
  std::string why_silent() const;
  /// The bodies of which poses come: their frames, or the topic if its messages name none.
  std::vector<std::string> bodies() const { return {bodies_.begin(), bodies_.end()}; }
  const std::string& body() const { return body_; }
  /// The frame that the poses are in; "" before the first one.
  const std::string& frame() const { return frame_; }

 private:
  bool is_wanted(const std::string& frame, const std::string& child);
  void take_pose(const ros2::StampedPose& pose);
  void take_transform(const ros2::StampedPose& transform);
  void add(const std::vector<std::string>& frames, std::int64_t time_ns, const Pose3& pose);
  std::string why_not_connected() const;

  RosBody wanted_;
  std::string body_, frame_;
  FrameTree tree_;
  std::set<std::string> bodies_;
  std::set<std::string> frames_;  // those that messages of the topic have been in
  bool transforms_ = false;       // the messages are transforms between frames
  std::size_t unreadable_ = 0;
  std::vector<RosPose> poses_;
};

}  // namespace astro::truth
