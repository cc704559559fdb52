#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "host/import/drives/stated_drives.hpp"

/// What a question states about drives.
namespace astro::page {

/// The topic of the laser scanner, of bags that have several.
inline constexpr const char* kScanTopic = "scan_topic";

/// Members (all may be missing; they are called as importing::name_of(Choice) calls them):
///   "drives"           [{"wheels": file, "truth": file}, ...]; the same file twice if it holds both
///   "wheel_columns", "truth_columns", "wheels_topic", "wheels_unit", "truth_topic", "body", "up", "truth_unit", "controller"
///   "truth_mirrored"   "yes" or "no"
///   "joints", "truth_frames"   two texts
///   "per_interval", "swap_wheels", "reverse_wheels", "drives_backward"
///   "counter_range", "wheel_diameter", "counts_per_turn", "wheelbase"   SI
///   "robot"            a file
/// and, read by the call that uses it, kScanTopic.
///
/// Throws astro::Error naming a member that is of another type or beyond its limits.
importing::StatedDrives statements_in(const nlohmann::json& question, const std::filesystem::path& folder);

}  // namespace astro::page
