#include "host/lidar/surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace astro::lidar {
namespace {

constexpr double kWindow_m = 0.12;
constexpr std::size_t kFewestBeside = 3, kMostBeside = 20;

Twist2 part_of(const Twist2& motion, double share) {
  return {share * motion.x_m, share * motion.y_m, share * motion.theta_rad};
}

/// Where the scanner was at a beam, seen from where it was at the first one.
class BeamPoses {
 public:
  explicit BeamPoses(std::span<const Twist2> way) : way_(way) {}

  /// To be called for the beams in order; `share` of the scan's time, below 1.
  Pose2 at(double share) {
    const double place = share * static_cast<double>(way_.size());
    for (; static_cast<double>(part_ + 1) <= place && part_ + 1 < way_.size(); ++part_)
      begin_ = begin_ * way_[part_].exp();
    return begin_ * part_of(way_[part_], place - static_cast<double>(part_)).exp();
  }

 private:
  std::span<const Twist2> way_;
  std::size_t part_ = 0;
  Pose2 begin_;  // of the part
};

std::vector<SurfacePoint> points_of(const Scan& scan, std::span<const Twist2> way) {
  std::vector<SurfacePoint> points;
  BeamPoses poses(way);
  const auto beams = static_cast<double>(scan.ranges_m.size());
  points.reserve(scan.ranges_m.size());
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    const double range_m = scan.ranges_m[beam];
    if (!(range_m > scan.range_min_m && range_m < scan.range_max_m)) continue;
    const double angle_rad = scan.first_angle_rad + static_cast<double>(beam) * scan.angle_step_rad;
    const Point2 seen{range_m * std::cos(angle_rad), range_m * std::sin(angle_rad)};
    const Point2 at = beam > 0 && !way.empty() ? poses.at(static_cast<double>(beam) / beams) * seen : seen;
    // Odd angles or times of a scan give points that have no order.
    if (std::isfinite(at.x_m) && std::isfinite(at.y_m)) points.push_back({at, {}, false});
  }
  return points;
}

/// The scatter of points about their mean, seen as an ellipse.
struct Scatter {
  double count = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;

  void add(const Point2& point) {
    count += 1;
    x += point.x_m;
    y += point.y_m;
    xx += point.x_m * point.x_m;
    xy += point.x_m * point.y_m;
    yy += point.y_m * point.y_m;
  }
};

/// Sets the normal if the scatter is thin: across it less than 28 % of the standard deviation along it.
void set_normal(const Scatter& sum, SurfacePoint& point) {
  constexpr double kFewest = 4, kThin = 0.08;
  if (sum.count < kFewest) return;
  const double xx = sum.xx - sum.x * sum.x / sum.count, xy = sum.xy - sum.x * sum.y / sum.count,
               yy = sum.yy - sum.y * sum.y / sum.count;
  const double middle = (xx + yy) / 2, half = std::hypot((xx - yy) / 2, xy);
  if (!(middle - half < kThin * (middle + half))) return;
  const double along_rad = std::atan2(2 * xy, xx - yy) / 2;
  point.normal = {-std::sin(along_rad), std::cos(along_rad)};
  point.on_line = true;
}

void find_normal(std::span<SurfacePoint> points, std::size_t i, double step_rad) {
  constexpr double kGrazing = 0.06;  // of the range: beams that meet a wall at a flat angle lie far apart
  SurfacePoint& point = points[i];
  const double range_m = std::hypot(point.at.x_m, point.at.y_m), apart_m = range_m * step_rad;
  const std::size_t beside = apart_m * static_cast<double>(kMostBeside) > kWindow_m
                                 ? std::max(kFewestBeside, static_cast<std::size_t>(kWindow_m / apart_m))
                                 : kMostBeside;
  const double reach_m = std::max(2 * kWindow_m, kGrazing * range_m);
  Scatter sum;
  for (std::size_t k = i - std::min(i, beside); k <= std::min(i + beside, points.size() - 1); ++k) {
    const double dx_m = points[k].at.x_m - point.at.x_m, dy_m = points[k].at.y_m - point.at.y_m;
    if (dx_m * dx_m + dy_m * dy_m < reach_m * reach_m) sum.add({dx_m, dy_m});
  }
  set_normal(sum, point);
}

}  // namespace

std::vector<SurfacePoint> surface_of(const Scan& scan, std::span<const Twist2> way) {
  std::vector<SurfacePoint> points = points_of(scan, way);
  for (std::size_t i = 0; i < points.size(); ++i) find_normal(points, i, std::abs(scan.angle_step_rad));
  return points;
}

Scan mirrored(Scan scan) {
  scan.first_angle_rad = -scan.first_angle_rad;
  scan.angle_step_rad = -scan.angle_step_rad;
  return scan;
}

}  // namespace astro::lidar
