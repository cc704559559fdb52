#include "host/lidar/scan_path.hpp"

#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "host/lidar/driven_surface.hpp"
#include "host/lidar/keyframes.hpp"
#include "host/lidar/mounting_search.hpp"
#include "host/lidar/pair_match.hpp"
#include "host/lidar/stretch_fit.hpp"

namespace astro::lidar {
namespace {

using calibration::WheelFactors;

constexpr std::size_t kFewestMatches = 3;
constexpr double kHalf = 0.5;                        // of the points, on lines of the first scan
constexpr double kApart_m = 0.4, kApart_rad = 0.35;  // as keyframes are

/// Where the scanner sits, by this drive alone.
Unknowns placed_scanner(const ScannedDrive& drive, const WheelFactors& loaded) {
  Unknowns start = nothing_wrong(loaded);
  start(kLeverYaw) = require_mounting({&drive, 1}, loaded, false).yaw_rad;
  const Keyframes keyframes = keyframes_of(drive, loaded, start, false);
  if (keyframes.counts.matched < kFewestMatches) return start;
  return iterated_fit(keyframes.stretches, wide_prior(start, drive.times_measured), loaded).fit.unknowns;
}

class Follower {
 public:
  Follower(const ScannedDrive& drive, const WheelFactors& loaded)
      : drive_(drive), loaded_(loaded), at_(placed_scanner(drive, loaded)) {}

  void add(const Scan& scan) {
    const double time_s = drive_.seconds(scan), on_wheels_s = time_s - at_(kLate);
    if (!(on_wheels_s >= drive_.wheels.front().time_s && on_wheels_s <= drive_.wheels.back().time_s)) return;
    std::vector<SurfacePoint> points = driven_surface(drive_, scan, loaded_, at_, false);
    if (!poses_.empty()) {
      const Stretch since = cut_stretch(drive_.wheels, loaded_, last_s_, time_s, at_(kLate));
      scanner_ = scanner_ * predicted(since, at_, loaded_);
    }
    const std::optional<Pose2> found = first_ ? placed(points) : anchored(points);
    if (found) scanner_ = *found;
    last_s_ = time_s;
    poses_.push_back({on_wheels_s, scanner_, found.has_value()});
    remember(std::move(points), found.has_value());
  }

  std::vector<ScannedPose> robot_poses() && {
    const Pose2 lever = lever_of(at_), back = lever.inverse();
    for (ScannedPose& pose : poses_) pose.robot = lever * pose.robot * back;
    return std::move(poses_);
  }

 private:
  struct Place {
    Pose2 scanner;
    NearestPoints surface;
  };

  std::optional<Pose2> on(const Place& place, std::span<const SurfacePoint> points,
                          double least_overlap) const {
    const auto match = trusted_match(place.surface, points, place.scanner.between(scanner_));
    if (!match || match->degenerate() || match->overlap < least_overlap) return std::nullopt;
    Pose2 found = place.scanner * match->motion;
    found.theta_rad = scanner_.theta_rad + wrapped_rad(found.theta_rad - scanner_.theta_rad);
    return found;
  }
  std::optional<Pose2> placed(std::span<const SurfacePoint> points) const {
    if (const auto found = on(*first_, points, kHalf)) return found;
    return on(near_ ? *near_ : *first_, points, 0);
  }
  /// Where the wheels say, if the scan shows so much that others can be matched with it.
  std::optional<Pose2> anchored(const std::vector<SurfacePoint>& points) const {
    const auto match = trusted_match(NearestPoints(points), points, {});
    if (!match || match->degenerate()) return std::nullopt;
    return scanner_;
  }
  void remember(std::vector<SurfacePoint> points, bool known) {
    if (!first_) {
      if (!known) return;
      first_ = Place{scanner_, NearestPoints(std::move(points))};
      return;
    }
    const Pose2 since = (near_ ? *near_ : *first_).scanner.between(scanner_);
    if (known && (std::hypot(since.x_m, since.y_m) > kApart_m || std::abs(since.theta_rad) > kApart_rad))
      near_ = Place{scanner_, NearestPoints(std::move(points))};
  }

  const ScannedDrive& drive_;
  const WheelFactors& loaded_;
  Unknowns at_;
  std::optional<Place> first_, near_;
  Pose2 scanner_;  // at the last scan, seen from where it was at the first
  double last_s_ = 0;
  std::vector<ScannedPose> poses_;
};

}  // namespace

std::vector<ScannedPose> path_by_scans(const ScannedDrive& drive, const WheelFactors& loaded) {
  Follower follower(drive, loaded);
  drive.read_scans([&](const Scan& scan) { follower.add(scan); });
  return std::move(follower).robot_poses();
}

}  // namespace astro::lidar
