#include "host/import/bags/odometry_wheels.hpp"

#include <cmath>
#include <utility>

#include "host/base/pose2.hpp"
#include "host/calibration/motion/arc.hpp"
#include "host/formats/messages/ros_messages.hpp"
#include "host/import/bags/pose_topics.hpp"
#include "host/import/wheels/unclear_choice.hpp"

namespace astro::importing {
namespace {

Pose2 planar(const TimedPose& pose) {
  return {pose.x_m, pose.y_m, ros2::heading_of({pose.qx, pose.qy, pose.qz, pose.qw})};
}

struct Travel {
  double left_m = 0, right_m = 0;
};

/// The inverse of calibration::advance: true travels first. The effective wheelbase depends on them, if
/// slightly, so it is found by iteration.
Travel nominal_travel(const Twist2& arc, const calibration::WheelFactors& factors) {
  constexpr int kIterations = 8;
  Travel travel;
  double wheelbase_m = factors.b_m;
  for (int i = 0; i < kIterations; ++i) {
    const double half_m = wheelbase_m * arc.theta_rad / 2;
    travel = {arc.x_m - half_m, arc.x_m + half_m};
    wheelbase_m = calibration::effective_wheelbase_m(travel.right_m, travel.left_m, factors);
  }
  return {travel.left_m / factors.c_l, travel.right_m / factors.c_r};
}

}  // namespace

WheelTrack wheels_of_odometry(const std::filesystem::path& path, const std::string& topic,
                              const calibration::WheelFactors& factors) {
  PoseTopic poses = poses_in_bag(path, {topic, "", ""});
  WheelTrack track;
  track.unit = WheelUnit::metres;
  track.clock = poses.stream.stamps.most_are_set() ? WheelClock::stamp : WheelClock::receipt;
  track.odometry = topic;
  for (Remark& remark : poses.remarks)
    if (remark.kind != Kind(ChoiceRemark::poses_may_be_estimate) &&
        remark.kind != Kind(ChoiceRemark::poses_recognised))
      track.remarks.push_back(std::move(remark));
  track.remarks.push_back({"the wheels were worked out from the robot's odometry " + topic +
                               " and its nominal sizes; they are right only if its program uses the wheels "
                               "alone, without a gyro or a filter",
                           ChoiceRemark::wheels_from_odometry,
                           {topic}});
  double along_m = 0, sideways_m = 0;
  WheelSample sum;
  Pose2 before;
  for (const TimedPose& timed : poses.poses) {
    const Pose2 pose = planar(timed);
    if (!std::isfinite(pose.x_m) || !std::isfinite(pose.y_m) || !std::isfinite(pose.theta_rad)) continue;
    if (!track.samples.empty()) {
      Pose2 step = before.between(pose);
      step.theta_rad = wrapped_rad(step.theta_rad);
      const Twist2 arc = step.log();
      const Travel travel = nominal_travel(arc, factors);
      sum.left += travel.left_m;
      sum.right += travel.right_m;
      along_m += std::abs(arc.x_m);
      sideways_m += std::abs(arc.y_m);
    }
    before = pose;
    track.samples.push_back({timed.time_ns, sum.left, sum.right});
  }
  if (track.samples.size() < 2)
    throw Error(path.string() + ": " + topic +
                " has fewer than two messages with poses: name the right file");
  constexpr double kMostSideways = 0.05;
  if (sideways_m > kMostSideways * along_m)
    track.remarks.push_back({"the poses of " + topic + " move sideways by " +
                             std::to_string(std::lround(100 * sideways_m / std::max(along_m, 1e-9))) +
                             " % of their way, which two wheels cannot"});
  return track;
}

}  // namespace astro::importing
