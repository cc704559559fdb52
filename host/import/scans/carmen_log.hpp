#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/base/bytes.hpp"
#include "host/lidar/scanned_drive.hpp"

/// Logs of CARMEN (also packed with gzip): odometry and scans of a robot, a message a line.
///
///   ODOM x y theta tv rv accel ...
///   FLASER n range[1..n] x y theta odom_x odom_y odom_theta ...
///
/// The beams run counter-clockwise from -90 degrees; n of them cover half a turn, the last one is at +90 degrees if n is odd. The
/// times in many of these logs mean nothing, so only the order of the lines counts.
///
/// A trap: in logs that a mapping program has corrected, the poses of FLASER lines are its results. The ODOM lines after a scan
/// go on from the corrected pose, so odometry is the motion between lines but for the leap onto each scan. In raw logs there is no
/// leap, and the way to the scan is odometry as well. Which of the two a log is shows in the leaps: odometry is repeated from
/// the corrected pose, and corrections move sideways and backward, as wheels cannot.
namespace astro::importing {

/// Why a file gives no scans. Values: the file; of topic_unclear the topics.
/// all_unreadable also the topic and how many scans it has.
enum class ScanFileProblem {
  no_odometry,
  no_scans,
  not_scans,
  topic_unclear,
  no_topics,
  wheels_of_other_file,
  all_unreadable
};

struct CarmenLog {
  bool corrected = false;  // by a mapping program
  std::size_t scans = 0, odometry = 0;
  std::size_t damaged = 0;           // lines that do not have what their first word says; left out
  double way_m = 0, turned_rad = 0;  // by odometry, all turns added up
  lidar::ScannedDrive drive;         // named after the file; reads the text again for the scans
};

/// Whether the file looks like such a log by its first lines.
bool is_carmen_log(const std::filesystem::path& path);

/// Travel of wheels that would make the odometry, on this wheelbase, c_R = c_L = 1.
/// Throws astro::Error naming the file if it has no ODOM lines or no scans, or as tables::text_of_file does.
CarmenLog read_carmen_log(const std::filesystem::path& path, double wheelbase_m);

}  // namespace astro::importing
