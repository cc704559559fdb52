#include "host/truth/trackers/ros_pose_stream.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/base/error.hpp"

namespace astro::truth {
namespace {

constexpr std::size_t kMostNames = 256;  // that are kept to be listed

/// Very long names are refused, because names are kept and would hold their memory for ever.
bool has_usual_names(const ros2::StampedPose& pose) {
  constexpr std::size_t kLongestName = 1000;
  return pose.frame.size() <= kLongestName && pose.child_frame.size() <= kLongestName;
}

void note(std::set<std::string>& names, const std::string& name) {
  if (names.size() < kMostNames) names.insert(name);
}

/// "'a', 'b', 'c' and 9 more"
template <class Names>
std::string list_of(const Names& names) {
  constexpr std::size_t kMostListed = 8;
  std::string list;
  std::size_t listed = 0;
  for (const std::string& name : names) {
    if (listed == kMostListed) return fmt::format("{} and {} more", list, names.size() - listed);
    list += (list.empty() ? "'" : ", '") + name + "'";
    ++listed;
  }
  return list;
}

/// "odom", "robot1/odom", "odom_combined", "wheel_odometry".
bool says_odometry(std::string_view frame) {
  return frame.substr(frame.rfind('/') + 1).find("odom") != std::string_view::npos;
}

}  // namespace

RosPoseStream::RosPoseStream(RosBody wanted)
    : wanted_{std::move(wanted.topic), plain_frame(wanted.parent), plain_frame(wanted.child)},
      body_(wanted_.child) {}

void RosPoseStream::push(std::string_view type, ByteView message) {
  const auto poses = ros2::poses_in(type, message);
  if (!poses || !std::ranges::all_of(*poses, has_usual_names)) {
    ++unreadable_;
    return;
  }
  transforms_ = type == ros2::tf_message_type().name;
  for (const ros2::StampedPose& pose : *poses) transforms_ ? take_transform(pose) : take_pose(pose);
}

void RosPoseStream::push_fixed(ByteView message) {
  const auto transforms = ros2::poses_in(ros2::tf_message_type().name, message);
  if (!transforms || !std::ranges::all_of(*transforms, has_usual_names)) return;
  for (const ros2::StampedPose& transform : *transforms) tree_.put(transform, true);
}

/// Takes note of a body, and chooses the first one if none was named.
bool RosPoseStream::is_wanted(const std::string& frame, const std::string& child) {
  const bool in_parent = wanted_.parent.empty() || frame == wanted_.parent;
  note(frames_, frame);
  if (in_parent || !wanted_.child.empty()) note(bodies_, child);
  if (in_parent && body_.empty()) body_ = child;
  return in_parent && child == body_;
}

void RosPoseStream::take_pose(const ros2::StampedPose& pose) {
  const std::string frame = plain_frame(pose.frame), child = plain_frame(pose.child_frame);
  if (!is_wanted(frame, child.empty() ? wanted_.topic : child)) return;
  add({child, frame}, pose.time_ns, {pose.x_m, pose.y_m, pose.z_m, pose.qx, pose.qy, pose.qz, pose.qw});
}

void RosPoseStream::take_transform(const ros2::StampedPose& transform) {
  const std::string child = plain_frame(transform.child_frame);
  tree_.put(transform, false);
  is_wanted(plain_frame(transform.frame), child);
  const std::vector<std::string> chain = tree_.chain(body_, wanted_.parent);
  const bool connected = wanted_.parent.empty() ? chain.size() == 2 : chain.back() == wanted_.parent;
  if (connected && tree_.moving(chain) == child) add(chain, transform.time_ns, tree_.pose(chain));
}

/// `frames`: from the body's own up to the one that its pose is in.
void RosPoseStream::add(const std::vector<std::string>& frames, std::int64_t time_ns, const Pose3& pose) {
  if (const auto odometry = std::ranges::find_if(frames, says_odometry); odometry != frames.end()) {
    const bool last = odometry + 1 == frames.end();
    throw Error(
        fmt::format("the poses of {} are {} the frame '{}': they are what the robot computes from its "
                    "own wheels, and no ground truth",
                    wanted_.topic, last ? "in" : "by way of", *odometry),
        last ? PoseProblem::in_odometry_frame : PoseProblem::by_odometry_frame, {wanted_.topic, *odometry});
  }
  frame_ = frames.back();
  poses_.push_back({time_ns, pose});
}

std::string RosPoseStream::why_silent() const {
  if (!frame_.empty()) return "";
  if (frames_.empty())
    return unreadable_ == 0 ? "no message has come"
                            : fmt::format("{} messages have come, and none fits its type", unreadable_);
  if (transforms_ && !wanted_.child.empty()) return why_not_connected();
  if (!wanted_.child.empty() && !bodies_.contains(wanted_.child))
    return fmt::format("it knows no '{}'; it has poses of {}", wanted_.child, list_of(bodies_));
  return fmt::format("its poses are in {}, not in '{}'", list_of(frames_), wanted_.parent);
}

std::string RosPoseStream::why_not_connected() const {
  const std::vector<std::string> chain = tree_.chain(wanted_.child, wanted_.parent);
  if (chain.size() == 1)
    return fmt::format("it knows no '{}'; it has transforms of {}", wanted_.child, list_of(bodies_));
  if (wanted_.parent.empty() || chain.back() == wanted_.parent)
    return fmt::format("'{}' stands still in '{}': all transforms between them are fixed", chain.front(),
                       chain.back());
  return fmt::format("'{}' is not below '{}'; above it are {}", wanted_.child, wanted_.parent,
                     list_of(std::vector<std::string>(chain.begin() + 1, chain.end())));
}

}  // namespace astro::truth
