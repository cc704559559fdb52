#include "host/film/camera/film_poses.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/base/order_statistics.hpp"
#include "host/film/camera/frame_pose.hpp"

namespace astro::film {
namespace {

constexpr double kNeighbours_s = 0.15;  // pictures further apart do not show the speed between them

RobotVelocity velocity_between(const FilmPose& from, const FilmPose& to) {
  const double dt_s = to.time_s - from.time_s;
  if (!(dt_s > 0) || dt_s > 2 * kNeighbours_s) return {};
  const Pose2 change = difference(to.pose, from.pose);
  return {change.x_m / dt_s, change.y_m / dt_s, change.theta_rad / dt_s};
}

void add_velocities(std::vector<FilmPose>& poses) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto near = [&](std::size_t k) {
      return std::abs(poses[k].time_s - poses[i].time_s) < kNeighbours_s;
    };
    const std::size_t before = i > 0 && near(i - 1) ? i - 1 : i;
    const std::size_t after = i + 1 < poses.size() && near(i + 1) ? i + 1 : i;
    poses[i].velocity = velocity_between(poses[before], poses[after]);
  }
}

/// Refines the poses, starting from their present values and velocities. Removes a pose that does not
/// converge from both lists, so that they stay aligned.
void refine(const Scene& scene, std::vector<FilmPose>& poses, std::vector<RobotTagSeen>& seen) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto found = frame_pose(scene, seen[i].corners, poses[i].pose, poses[i].velocity);
    if (!found) continue;
    poses[i].pose = found->pose;
    poses[i].covariance = found->cofactor;
    poses[i].rms_px = found->rms_px;
    poses[kept] = poses[i];
    seen[kept++] = seen[i];
  }
  poses.resize(kept);
  seen.resize(kept);
}

double median_misfit(const std::vector<FilmPose>& poses) {
  std::vector<double> all;
  for (const FilmPose& pose : poses) all.push_back(pose.rms_px);
  return median_of(std::move(all));
}

void drop_misfits(std::vector<FilmPose>& poses) {
  constexpr double kTimes = 4, kHarmless_px = 0.5;
  const double limit = std::max(kTimes * median_misfit(poses), kHarmless_px);
  std::erase_if(poses, [&](const FilmPose& pose) { return pose.rms_px > limit; });
}

/// Drops poses that are not later than the one before: if the rows are read slowly, the tag in the next
/// picture may be seen earlier.
void drop_unordered(std::vector<FilmPose>& poses) {
  std::vector<FilmPose> ordered;
  for (const FilmPose& pose : poses)
    if (ordered.empty() || pose.time_s > ordered.back().time_s) ordered.push_back(pose);
  poses = std::move(ordered);
}

void unwrap(std::vector<FilmPose>& poses) {
  for (std::size_t i = 1; i < poses.size(); ++i)
    poses[i].pose.theta_rad =
        poses[i - 1].pose.theta_rad + wrapped_rad(poses[i].pose.theta_rad - poses[i - 1].pose.theta_rad);
}

}  // namespace

FilmPoses film_poses(const Scene& scene, const std::vector<RobotTagSeen>& all) {
  FilmPoses found;
  std::vector<RobotTagSeen> seen;
  for (const RobotTagSeen& one : all) {
    const auto rough = rough_pose(scene, one.corners);
    if (!rough) continue;
    seen.push_back(one);
    found.poses.push_back({one.pts_s, one.pts_s + row_delay_s(scene, one.corners), *rough, {}});
  }
  for (int round = 0; round < 2; ++round) {
    add_velocities(found.poses);
    refine(scene, found.poses, seen);
  }
  if (!found.poses.empty()) drop_misfits(found.poses);
  drop_unordered(found.poses);
  found.dropped = all.size() - found.poses.size();
  unwrap(found.poses);
  add_velocities(found.poses);
  double squares = 0;
  for (const FilmPose& pose : found.poses) squares += 8 * pose.rms_px * pose.rms_px;
  // Of the eight coordinates of a picture, three degrees of freedom go into the pose.
  if (!found.poses.empty())
    found.corner_px = std::sqrt(squares / (5 * static_cast<double>(found.poses.size())));
  for (FilmPose& pose : found.poses) pose.covariance *= found.corner_px * found.corner_px;
  return found;
}

}  // namespace astro::film
