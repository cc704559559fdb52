#pragma once

#include <cstddef>
#include <span>

#include "host/lidar/scanned_drive.hpp"
#include "host/lidar/stretch.hpp"

/// How the scanner is mounted, roughly: which way it looks, and whether its beams run the way that its scans say. Pairs of scans
/// match where the wheels put them only if both are right.
namespace astro::lidar {

struct MountingFound {
  double yaw_rad = 0;       // the scanner's x axis on the robot, to about 15 degrees
  std::size_t driving = 0;  // pairs that were tried: straight on
  std::size_t turning = 0;  // and turning, without which a mirror image does not show
  /// Shares of the points that find lines in the turning pairs, on average: as the scans say, and if the beams run the other way
  /// round.
  double overlap = 0, mirrored_overlap = 0;
};

/// mirrored: a person said that the beams run the other way round than the scans say; then the result is about the scans with
/// that put right. Cost: some 50 matches if the scanner looks forward, otherwise 800.
MountingFound find_mounting(std::span<const ScannedDrive> drives, const calibration::WheelFactors& loaded,
                            bool mirrored);

/// Whether the turning pairs match clearly better as a mirror image.
bool looks_mirrored(const MountingFound& found);
/// Whether there are enough of them for a mirror image to show.
bool shows_mirror_images(const MountingFound& found);

/// find_mounting, of scans that are as a person says. Throws astro::Error with ScanProblem::mirrored or not_mirrored otherwise.
MountingFound require_mounting(std::span<const ScannedDrive> drives, const calibration::WheelFactors& loaded,
                               bool mirrored);

}  // namespace astro::lidar
