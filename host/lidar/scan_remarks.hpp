#pragma once

#include <span>
#include <vector>

#include "host/lidar/mounting_search.hpp"
#include "host/lidar/scan_calibration.hpp"

namespace astro::lidar {

/// What these drives do not show, and what is odd about them: of the kinds of ScanRemark.
std::vector<Remark> remarks_on(std::span<const LongMatch> long_matches, const MountingFound& mounting,
                               const ScanCalibration& found);

}  // namespace astro::lidar
