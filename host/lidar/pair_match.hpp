#pragma once

#include <optional>
#include <span>

#include "host/lidar/scan_match.hpp"

namespace astro::lidar {

/// The match of two scans of neighbouring keyframes if it can be trusted: a quarter of the points found lines, which are at most
/// 6 cm off, and the result is near to where it started. If the first try is poor, starts that are turned by 5 degrees to either
/// side are tried as well, for wheels that slip while they turn.
std::optional<ScanMatch> trusted_match(const NearestPoints& reference, std::span<const SurfacePoint> scan,
                                       const Pose2& start);

}  // namespace astro::lidar
