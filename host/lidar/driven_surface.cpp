#include "host/lidar/driven_surface.hpp"

namespace astro::lidar {

std::vector<SurfacePoint> driven_surface(const ScannedDrive& drive, const Scan& scan,
                                         const calibration::WheelFactors& loaded, const Unknowns& unknowns,
                                         bool mirror) {
  constexpr int kParts = 8;
  const double part_s = scan.beam_interval_s * static_cast<double>(scan.ranges_m.size()) / kParts;
  std::vector<Twist2> way;
  for (int part = 0; part < kParts && part_s > 0; ++part) {
    const double from_s = drive.seconds(scan) + part * part_s;
    const Stretch during = cut_stretch(drive.wheels, loaded, from_s, from_s + part_s, unknowns(kLate));
    way.push_back(predicted(during, unknowns, loaded).log());
  }
  return mirror ? surface_of(mirrored(scan), way) : surface_of(scan, way);
}

}  // namespace astro::lidar
