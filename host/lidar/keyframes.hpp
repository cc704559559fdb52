#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "host/calibration/motion/wheel_path.hpp"
#include "host/lidar/scan_match.hpp"
#include "host/lidar/scanned_drive.hpp"
#include "host/lidar/stretch.hpp"

/// From the scans of a drive to stretches between keyframes: scans that are so far apart that the motion in between is larger than
/// the error of a match, and so near that they still show the same walls.
namespace astro::lidar {

/// What became of the scans of a drive.
struct ScanCounts {
  std::size_t scans = 0;       // that were read
  std::size_t outside = 0;     // before the first or after the last sample of the wheels
  std::size_t matched = 0;     // keyframes whose motion was found
  std::size_t degenerate = 0;  // of these: in one direction only
  std::size_t unmatched = 0;   // keyframes that do not fit to the one before
  std::size_t gaps = 0;        // the robot went on for too long without a scan
  std::size_t slipped = 0;     // the robot is known to have slipped since the keyframe before

  ScanCounts& operator+=(const ScanCounts& other);
};

/// The same motion by one match over some metres, and by the chain of the matches in between. A matcher that is always a bit off in
/// the same direction is so in every match, so the chain is off by more.
struct LongMatch {
  Pose2 direct, chained;
  double length_m = 0;
};

class Keyframes {
 public:
  /// start: what is known of the scanner's place and of its stamps. mirrored: the beams run the other way round than the scans
  /// say. `drive` must outlive this.
  Keyframes(const ScannedDrive& drive, const calibration::WheelFactors& loaded, const Unknowns& start,
            bool mirrored);

  /// The next scan. Cost: a match if it becomes a keyframe, and twice that each 3 m; otherwise next to nothing.
  void add(const Scan& scan);

  std::vector<Stretch> stretches;
  std::vector<LongMatch> long_matches;
  ScanCounts counts;

 private:
  struct Keyframe {
    double time_s;
    calibration::WheelState wheels;
    NearestPoints surface;
  };
  /// The keyframe where a long match begins, and the motion since then.
  struct Anchor {
    NearestPoints surface;
    Pose2 since;
    double length_m = 0;
  };
  std::optional<ScanMatch> add_stretch(double time_s, const calibration::WheelState& wheels,
                                       std::span<const SurfacePoint> points);
  void check_long(const std::optional<ScanMatch>& found, const NearestPoints& surface);

  const ScannedDrive& drive_;
  calibration::WheelFactors loaded_;
  Unknowns start_;
  bool mirrored_;
  calibration::WheelPath path_;
  std::optional<Keyframe> last_;
  std::optional<Anchor> anchor_;
};

/// The whole drive.
Keyframes keyframes_of(const ScannedDrive& drive, const calibration::WheelFactors& loaded,
                       const Unknowns& start, bool mirrored);

}  // namespace astro::lidar
