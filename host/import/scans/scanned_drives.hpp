#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/experiment/analysis/trajectories.hpp"
#include "host/import/drives/import_drives.hpp"
#include "host/import/drives/stated_drives.hpp"
#include "host/lidar/scanned_drive.hpp"

namespace astro::importing {

/// Drives whose wheels and whose scans other programs recorded, as the calibration by scans takes them.
struct ScannedDrives {
  std::vector<lidar::ScannedDrive> drives;
  calibration::WheelFactors loaded;               // of the odometry while they were driven
  std::optional<experiment::NominalWheel> wheel;  // that c_R and c_L refer to; none if it is not known
  std::vector<Remark> remarks;                    // what was found, inferred or left out
  experiment::RunSet set;  // the wheels of the drives as runs, with their gyros; none of logs of CARMEN
};

/// Whether a file of ground truth is one of scans: a log of CARMEN, or a bag that has scans but no poses of a tracker, unless poses
/// are named.
bool gives_scans(const std::filesystem::path& path, const StatedDrives& stated);

/// Each drive's truth is the file with its scans: a bag, or a log of CARMEN, which holds the wheels as well, so that both are the
/// same file. Of a CARMEN log only the wheelbase has to be known, because it has odometry instead of wheels.
/// scan_topic: of bags; "" for the only one.
///
/// Throws astro::Error if a topic is named for logs of CARMEN; naming the file if scans are in neither kind of file, or such a log
/// is to give scans for other wheels; if the drives are of robots with different wheels or factors; and what import_wheels,
/// read_carmen_log and scans_in_bag throw.
ScannedDrives scanned_drives(std::span<const DriveFiles> files, const ImportChoices& choices,
                             const std::string& scan_topic = {});

}  // namespace astro::importing
