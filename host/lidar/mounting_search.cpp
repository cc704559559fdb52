#include "host/lidar/mounting_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/base/error.hpp"
#include "host/calibration/motion/wheel_path.hpp"
#include "host/lidar/pair_match.hpp"
#include "host/lidar/scan_problem.hpp"

namespace astro::lidar {
namespace {

constexpr std::size_t kPairs = 24;  // of each kind
constexpr double kDriven_m = 0.3, kStraight_rad = 0.15, kTurned_rad = 0.22;
constexpr double kPairApart_m = 0.4, kPairApart_rad = 0.3, kPairTooFar_m = 1.5, kPairTooFar_rad = 1;

struct ScanPair {
  const ScannedDrive* drive;
  Scan first, second;
};

Pose2 by_wheels(const ScannedDrive& drive, const Scan& from, const Scan& to, const Unknowns& unknowns,
                const calibration::WheelFactors& loaded) {
  return predicted(cut_stretch(drive.wheels, loaded, drive.seconds(from), drive.seconds(to), 0), unknowns,
                   loaded);
}

/// Pairs of scans of both kinds from the beginning of the drives.
class Pairs {
 public:
  explicit Pairs(const calibration::WheelFactors& loaded) : loaded_(loaded) {}

  void collect(const ScannedDrive& drive) {
    last_.reset();
    path_.emplace(drive.wheels);
    drive.read_scans([&](const Scan& scan) { add(drive, scan); });
  }

  std::vector<ScanPair> driving, turning;

 private:
  void add(const ScannedDrive& drive, const Scan& scan) {
    if (driving.size() >= kPairs && turning.size() >= kPairs) return;
    const calibration::WheelState wheels = path_->at(drive.seconds(scan));
    if (last_) {
      // Far cheaper than all samples since the last scan, which may be those of an hour that the robot stood.
      if (is_near(wheels)) return;
      const Pose2 moved = by_wheels(drive, *last_, scan, nothing_wrong(loaded_), loaded_);
      const double length_m = std::hypot(moved.x_m, moved.y_m), turned_rad = std::abs(moved.theta_rad);
      if (length_m < kPairApart_m && turned_rad < kPairApart_rad) return;
      if (length_m < kPairTooFar_m && turned_rad < kPairTooFar_rad) {
        if (turned_rad > kTurned_rad && turning.size() < kPairs) turning.push_back({&drive, *last_, scan});
        if (turned_rad < kStraight_rad && length_m > kDriven_m && driving.size() < kPairs)
          driving.push_back({&drive, *last_, scan});
      }
    }
    last_ = scan;
    last_wheels_ = wheels;
  }

  /// Whether the robot is where the last scan was made, by both wheels' travel, which is at least as long as the way across.
  bool is_near(const calibration::WheelState& wheels) const {
    const double right_m = loaded_.c_r * (wheels.right_m - last_wheels_.right_m),
                 left_m = loaded_.c_l * (wheels.left_m - last_wheels_.left_m);
    return std::abs(right_m + left_m) / 2 < kPairApart_m &&
           std::abs(right_m - left_m) / loaded_.b_m < kPairApart_rad;
  }

  const calibration::WheelFactors& loaded_;
  std::optional<calibration::WheelPath> path_;
  std::optional<Scan> last_;
  calibration::WheelState last_wheels_;
};

/// The share of the points of each pair that find a line, on average; 0 for pairs that do not match.
double overlap(const std::vector<ScanPair>& pairs, const calibration::WheelFactors& loaded, double yaw_rad,
               bool mirror) {
  Unknowns unknowns = nothing_wrong(loaded);
  unknowns(kLeverYaw) = yaw_rad;
  double sum = 0;
  for (const ScanPair& pair : pairs) {
    const auto surface = [&](const Scan& scan) { return surface_of(mirror ? mirrored(scan) : scan, {}); };
    const std::vector<SurfacePoint> second = surface(pair.second);
    if (const auto found = trusted_match(NearestPoints(surface(pair.first)), second,
                                         by_wheels(*pair.drive, pair.first, pair.second, unknowns, loaded)))
      sum += found->overlap;
  }
  return pairs.empty() ? 0 : sum / static_cast<double>(pairs.size());
}

}  // namespace

MountingFound find_mounting(std::span<const ScannedDrive> drives, const calibration::WheelFactors& loaded,
                            bool mirrored) {
  constexpr double kPlain = 0.75;  // so good a match leaves no doubt
  constexpr int kDirections = 12;
  Pairs pairs(loaded);
  for (const ScannedDrive& drive : drives) pairs.collect(drive);
  MountingFound found{0, pairs.driving.size(), pairs.turning.size(), 0, 0};
  double best = -1;
  for (int direction = 0; direction < kDirections; ++direction) {
    const double yaw_rad = wrapped_rad(direction * 2 * std::numbers::pi / kDirections);
    const double driving = overlap(pairs.driving, loaded, yaw_rad, mirrored),
                 turning = overlap(pairs.turning, loaded, yaw_rad, mirrored);
    if (driving + turning > best) {
      best = driving + turning;
      found.overlap = turning;
      found.yaw_rad = yaw_rad;
    }
    if ((driving > kPlain || pairs.driving.empty()) && (turning > kPlain || pairs.turning.empty()))
      return found;
  }
  for (int direction = 0; direction < kDirections; ++direction)
    found.mirrored_overlap =
        std::max(found.mirrored_overlap,
                 overlap(pairs.turning, loaded, direction * 2 * std::numbers::pi / kDirections, !mirrored));
  return found;
}

bool looks_mirrored(const MountingFound& found) {
  constexpr double kTimes = 1.3, kClearly = 0.1;
  return found.mirrored_overlap > kTimes * found.overlap + kClearly;
}

bool shows_mirror_images(const MountingFound& found) {
  constexpr std::size_t kFewestTurning = 3;
  return found.turning >= kFewestTurning;
}

MountingFound require_mounting(std::span<const ScannedDrive> drives, const calibration::WheelFactors& loaded,
                               bool mirrored) {
  const MountingFound found = find_mounting(drives, loaded, mirrored);
  if (!looks_mirrored(found)) return found;
  const auto percent = [](double share) { return fmt::format("{:.0f}", 100 * share); };
  const std::vector<std::string> values{fmt::format("{}", found.turning), percent(found.overlap),
                                        percent(found.mirrored_overlap)};
  if (mirrored)
    throw Error(fmt::format("as mirror images the scans turn the robot the other way than the wheels: in {} "
                            "turns {} % of the points match, and {} % if each scan is taken as it is",
                            values[0], values[1], values[2]),
                ScanProblem::not_mirrored, values);
  throw Error(
      fmt::format("the scans turn the robot the other way than the wheels: in {} turns {} % of the "
                  "points match, and {} % if each scan is taken for a mirror image, as of a scanner whose "
                  "beams run the other way round or that hangs upside down, or if left and right wheel "
                  "are exchanged",
                  values[0], values[1], values[2]),
      ScanProblem::mirrored, values);
}

}  // namespace astro::lidar
