#pragma once

#include <vector>

#include "host/calibration/motion/wheel_factors.hpp"
#include "host/lidar/scanned_drive.hpp"
#include "host/lidar/stretch.hpp"
#include "host/lidar/surface.hpp"

namespace astro::lidar {

/// The points of a scan of a drive (surface_of), with the motion that the wheels tell for each eighth of the scan. With the mean motion
/// over the scan instead, a robot that begins or ends a turn meanwhile seems to do so some 10 ms late.
///
/// `unknowns`: what is known of the scanner's place and of its stamps; mirrored: the beams run the other way round than the scan says.
std::vector<SurfacePoint> driven_surface(const ScannedDrive& drive, const Scan& scan,
                                         const calibration::WheelFactors& loaded, const Unknowns& unknowns,
                                         bool mirrored);

}  // namespace astro::lidar
