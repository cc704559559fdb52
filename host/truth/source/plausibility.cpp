#include "host/truth/source/plausibility.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "host/base/degrees.hpp"
#include "host/recording/run/planar_pose.hpp"

namespace astro::truth {
namespace {

using recording::PlanarPose;

constexpr double kMostOfDistance = 0.25, kLeast_m = 0.2, kMost_rad = std::numbers::pi / 3;

PlanarPose pose_of(const recording::OdometrySample& sample) {
  return {sample.x_m, sample.y_m, sample.theta_rad};
}

double length_m(const recording::Run& run) {
  double length = 0;
  for (std::size_t i = 1; i < run.odometry.size(); ++i)
    length += std::hypot(run.odometry[i].x_m - run.odometry[i - 1].x_m,
                         run.odometry[i].y_m - run.odometry[i - 1].y_m);
  return length;
}

}  // namespace

std::string implausible_end(const recording::Run& run, const recording::TruthSample& start,
                            const recording::TruthSample& end) {
  if (run.odometry.empty()) return "";
  const PlanarPose odometry =
      recording::in_frame_of(pose_of(run.odometry.front()), pose_of(run.odometry.back()));
  const PlanarPose measured =
      recording::in_frame_of({start.x_m, start.y_m, start.theta_rad}, {end.x_m, end.y_m, end.theta_rad});
  const double driven_m = length_m(run);
  const double off_m = std::hypot(measured.x_m - odometry.x_m, measured.y_m - odometry.y_m);
  if (!(off_m <= std::max(kLeast_m, kMostOfDistance * driven_m)))
    return fmt::format(
        "this end is {:.4g} m from where odometry ends, after a run of {:.4g} m, as if it were not in "
        "metres.",
        off_m, driven_m);
  const double turned_rad = recording::wrapped_rad(measured.theta_rad - odometry.theta_rad);
  if (std::abs(turned_rad) > kMost_rad)
    return fmt::format(
        "this heading is {:.0f} degrees from that of odometry, as if it were not in degrees or not "
        "counter-clockwise.",
        degrees(std::abs(turned_rad)));
  return "";
}

}  // namespace astro::truth
