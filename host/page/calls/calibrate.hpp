#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "host/page/calls/calls.hpp"

namespace astro::page {

/// Calibrates from drives in files, by maximum likelihood, or by the scans of a laser scanner if these are the ground truth:
/// `calibrate files` and `calibrate bag`.
///
/// question  what is stated (statements.hpp); "scan_topic": of bags with several topics of scans
/// events    {"event": "imported", "drives": [{"name", "summary", "remarks": [...]}, ...]} before the estimate begins
/// answer    {"calibration": what `calibrate --json` prints, "drives": as above, "remarks": on all drives together,
///            "verdict": a sentence,
///            "advises_against": whether the drives are against loading the factors,
///            "toml", "report": files; "ros2": a file for diff_drive_controller, or null,
///            "not_in_ros2": what that file cannot express, or why there is none; otherwise null}
///
/// Throws astro::Error if only some drives have scans; and what importing::import_stated, importing::scanned_drives,
/// experiment::calibrate, lidar::calibrate_by_scans and statements_in throw.
nlohmann::json calibrate(const nlohmann::json& question, const std::filesystem::path& folder,
                         const Emit& emit);

}  // namespace astro::page
