#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/experiment/files/run_set.hpp"
#include "host/lidar/scanned_drive.hpp"
#include "host/recording/run.hpp"

/// Recordings with the scans of a laser scanner on the robot, as host/lidar takes them.
namespace astro::experiment {

/// All runs, with the slips that their robots' gyros show. The set must outlive them. Throws astro::Error as trajectory_of does.
std::vector<lidar::ScannedDrive> scanned_drives(const RunSet& set);

/// Replaces the truth by where the scans say that the robot's middle was, seen from where it was at the first scan. Samples where the
/// walls do not show it are not valid. Throws as scanned_drives and lidar::path_by_scans do; `run` is unchanged then.
void give_truth_by_scans(recording::Run& run);
/// The same for the runs that have scans and no truth, because they were recorded while another program drove.
void give_missing_truth_by_scans(std::span<recording::Run> runs);

}  // namespace astro::experiment
