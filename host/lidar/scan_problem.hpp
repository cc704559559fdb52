#pragma once

namespace astro::lidar {

/// Why scans do not calibrate. Values:
///   no_common_time  how many scans there are
///   do_not_match    how many pairs of scans match, and of how many
///   mirrored        how many turns were looked at, and how many percent of the points match in them, as the scans say and as a
///                   mirror image
///   not_mirrored    the same where a person says that the scans are mirrored: as mirror images, and as they are
enum class ScanProblem { no_common_time, do_not_match, mirrored, not_mirrored };

}  // namespace astro::lidar
