#pragma once

#include <vector>

#include "host/base/pose2.hpp"
#include "host/calibration/motion/trajectory.hpp"
#include "host/calibration/motion/wheel_factors.hpp"
#include "host/lidar/scanned_drive.hpp"

/// Where a robot was along one drive, by its scans: what a tracker would say of it, for end errors and figures.
namespace astro::lidar {

struct ScannedPose {
  double time_s = 0;   // on the wheels' clock
  Pose2 robot;         // seen from where it was at the first scan; heading not wrapped
  bool valid = false;  // otherwise the walls do not show it, and the pose is as the wheels say
};

/// A pose for each scan that was made while the wheels were recorded. As long as a scan shows half of what the first one shows, it is
/// laid onto that one, so that errors do not add up: a drive that ends where it began ends with the error of one match. Elsewhere it
/// is laid onto the last place that is known. The scanner's place on the robot is found from the drive itself.
///
/// Returns nothing if no scans were made meanwhile. Throws astro::Error with ScanProblem::mirrored if the scans are mirror images.
/// Cost  1 to 3 ms for each scan; memory for three of them.
std::vector<ScannedPose> path_by_scans(const ScannedDrive& drive, const calibration::WheelFactors& loaded);

}  // namespace astro::lidar
