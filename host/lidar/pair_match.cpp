#include "host/lidar/pair_match.hpp"

#include <cmath>

namespace astro::lidar {
namespace {

constexpr std::size_t kFewestPoints = 40;
constexpr double kLeastOverlap = 0.25, kMostSigma_m = 0.06;
constexpr double kFarthest_m = 0.4, kFarthest_rad = 0.3;  // from the start
constexpr double kGoodOverlap = 0.35, kGoodSigma_m = 0.04;
constexpr double kClearlyBetter = 1.02;
constexpr double kRetryTurned_rad = 0.08;

double quality(const ScanMatch& match) { return match.overlap / match.sigma_m; }

}  // namespace

std::optional<ScanMatch> trusted_match(const NearestPoints& reference, std::span<const SurfacePoint> scan,
                                       const Pose2& start) {
  if (reference.points().size() < kFewestPoints || scan.size() < kFewestPoints) return {};
  std::optional<ScanMatch> best;
  for (const double turned_rad : {0.0, kRetryTurned_rad, -kRetryTurned_rad}) {
    if (best && best->overlap > kGoodOverlap && best->sigma_m < kGoodSigma_m) break;
    const std::optional<ScanMatch> found =
        match(reference, scan, {start.x_m, start.y_m, start.theta_rad + turned_rad});
    if (found && (!best || quality(*found) > kClearlyBetter * quality(*best))) best = found;
  }
  if (!best || !(best->overlap > kLeastOverlap) || !(best->sigma_m < kMostSigma_m)) return {};
  const Pose2 off = difference(best->motion, start);
  if (!(std::hypot(off.x_m, off.y_m) < kFarthest_m) || !(std::abs(off.theta_rad) < kFarthest_rad)) return {};
  return best;
}

}  // namespace astro::lidar
