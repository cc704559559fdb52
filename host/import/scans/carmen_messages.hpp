#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

#include "host/base/pose2.hpp"
#include "host/lidar/scan.hpp"

/// The lines of a log of CARMEN that count: odometry, scans, and where a mapping program has finished with a scan.
namespace astro::importing {

struct CarmenMessage {
  bool is_scan = false;
  bool is_end_of_mapping = false;  // GMapping's NEFF, behind what it makes of a scan
  Pose2 robot;                     // where the line says that the robot is
  lidar::Scan scan;  // without a time; the limits of its ranges as the line says, 0 if it does not
};

/// Whether the text looks like such a log by its first lines.
bool is_carmen_log(std::string_view text);

/// The word at the beginning of lines with scans: a log may have the same scans in lines of two kinds.
std::string_view carmen_laser(std::string_view text);

/// Calls `handle` with each message in order. Returns how many lines are damaged: they do not have what their first word says.
std::size_t each_carmen_message(std::string_view text, std::string_view laser,
                                const std::function<void(CarmenMessage&)>& handle);

}  // namespace astro::importing
