#include "host/lidar/scan_map.hpp"

#include <cmath>

#include "host/lidar/driven_surface.hpp"

namespace astro::lidar {

std::vector<Point2> map_by_wheels(const ScannedDrive& drive, const calibration::WheelFactors& factors,
                                  const Unknowns& unknowns, bool mirrored, std::size_t most) {
  constexpr double kApart_m = 0.2, kApart_rad = 0.2;
  Unknowns place = nothing_wrong(factors);
  for (const Unknown k : {kLeverX, kLeverY, kLeverYaw, kLate}) place(k) = unknowns(k);
  const double begin_s = drive.wheels.front().time_s, end_s = drive.wheels.back().time_s;
  std::vector<Point2> points;
  Pose2 scanner = lever_of(place), kept = scanner;
  double last_s = begin_s + place(kLate);
  bool any = false;
  drive.read_scans([&](const Scan& scan) {
    const double time_s = drive.seconds(scan);
    if (!(time_s >= last_s && time_s - place(kLate) <= end_s)) return;
    scanner =
        scanner * predicted(cut_stretch(drive.wheels, factors, last_s, time_s, place(kLate)), place, factors);
    last_s = time_s;
    const Pose2 since = kept.between(scanner);
    if (any && std::hypot(since.x_m, since.y_m) < kApart_m && std::abs(since.theta_rad) < kApart_rad) return;
    any = true;
    kept = scanner;
    for (const SurfacePoint& point : driven_surface(drive, scan, factors, place, mirrored))
      points.push_back(scanner * point.at);
  });
  const std::size_t step = points.size() / (most + 1) + 1;
  std::vector<Point2> thinned;
  for (std::size_t i = 0; i < points.size(); i += step) thinned.push_back(points[i]);
  return thinned;
}

}  // namespace astro::lidar
