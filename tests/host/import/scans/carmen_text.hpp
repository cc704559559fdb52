#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/host/lidar/synthetic_room.hpp"

namespace astro::importing {

/// A synthetic drive as a log of CARMEN. corrected: as a mapping program rewrites it, whose poses are the true ones; odometry goes
/// on from them. Its lines say nothing of directions, so that the beams of a mirrored scanner stand in reverse.
inline std::string carmen_text(const lidar::SyntheticDrive& drive, bool corrected) {
  const lidar::ScannedDrive recorded = drive.recorded();
  std::string text = "# message formats defined: PARAM SYNC ODOM FLASER\n";
  std::size_t next = 0;
  Pose2 raw, shown;  // odometry, and where the log shows it
  const auto line = [](const Pose2& pose) {
    return fmt::format("{:.6f} {:.6f} {:.6f}", pose.x_m, pose.y_m, wrapped_rad(pose.theta_rad));
  };
  const auto odometry_to = [&](double time_s) {
    constexpr std::size_t kEach = 5;
    for (; next < recorded.wheels.size() && recorded.wheels[next].time_s <= time_s + 1e-6; ++next) {
      if (next == 0) continue;
      const calibration::WheelSample &a = recorded.wheels[next - 1], &b = recorded.wheels[next];
      Pose2 after = raw;
      calibration::advance(after, b.right_m - a.right_m, b.left_m - a.left_m, lidar::kNominalBase_m);
      shown = shown * raw.between(after);
      raw = after;
      if (next % kEach == 0) text += "ODOM " + line(shown) + " 0 0 0 1 host 1\n";
    }
  };
  recorded.read_scans([&](const lidar::Scan& scan) {
    odometry_to(recorded.seconds(scan));
    if (corrected) {
      text += "ODOM " + line(shown) + " 0 0 0 1 host 1\n";
      shown = drive.pose_at(recorded.seconds(scan));
    }
    text += fmt::format("FLASER {}", scan.ranges_m.size());
    std::vector<float> ranges_m = scan.ranges_m;
    if (scan.angle_step_rad < 0) std::reverse(ranges_m.begin(), ranges_m.end());
    for (const float range_m : ranges_m)
      text += fmt::format(" {:.3f}", std::isfinite(range_m) ? range_m : 30.0F);
    text += " " + line(shown) + " " + line(shown) + " 1 host 1\n";
    if (corrected) text += "ODOM " + line(shown) + " 0 0 0 1 host 1\nNEFF 15\n";
  });
  return text;
}

}  // namespace astro::importing
