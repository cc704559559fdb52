#pragma once

#include <cstddef>
#include <vector>

#include "host/base/pose2.hpp"
#include "host/calibration/motion/wheel_factors.hpp"
#include "host/lidar/scanned_drive.hpp"
#include "host/lidar/stretch.hpp"

namespace astro::lidar {

/// The points of the scans of a drive where dead reckoning with some factors puts them, seen from where the robot was at the first
/// sample of its wheels. With factors that are off, walls that were passed twice appear twice.
///
/// unknowns: what is known of the scanner's place and of its stamps. Scans are taken every 20 cm or 0.2 rad; if they have more than
/// `most` points, every n-th of these is kept.
std::vector<Point2> map_by_wheels(const ScannedDrive& drive, const calibration::WheelFactors& factors,
                                  const Unknowns& unknowns, bool mirrored, std::size_t most);

}  // namespace astro::lidar
