#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "host/base/error.hpp"
#include "host/lidar/factor_choice.hpp"
#include "host/lidar/keyframes.hpp"
#include "host/lidar/scan_problem.hpp"
#include "host/lidar/scanned_drive.hpp"

/// Calibrates the wheels of a robot by the scans of a scanner on it: without a tracker, in any place that has walls.
namespace astro::lidar {

/// What the drives do not show, each a clause that names the motion that is missing; or what is odd. Values as in the clause.
enum class ScanRemark {
  no_turns,        // b
  no_bend,         // E_d
  no_scale,        // S
  no_place,        // the scanner's x and y
  no_yaw,          // the scanner's yaw
  mirror_unknown,  // without turns a mirror image does not show
  one_direction,   // walls that show motion in one direction only: how many of how many matches
  unmatched,       // keyframes whose scans do not match: how many of how many
  gaps,            // the robot drove on without scans: how often
  outside,         // scans made before or after the wheels were recorded: how many of how many
  clocks_differ,  // the offset between the clocks of wheels and scans is another in other drives: by milliseconds
  clock_drifts,  // these clocks run at different rates within a drive: by parts in a million
  matcher_biased,  // matches over some metres differ from the chain of the matches in between: degrees for each metre
};

/// By how much the scans moved on further than the wheels say on a stretch, with the loaded factors and with those found.
struct StretchResidual {
  std::size_t drive = 0;
  double way_m = 0;  // that the scanner went in all drives before the stretch
  Pose2 loaded, found;
};

struct ScanCalibration {
  calibration::WheelFactors loaded, factors;
  /// Of c_R, c_L, b, e: what these drives and what is known before leave open.
  Eigen::Matrix4d covariance;
  calibration::LeverArm scanner, scanner_se;
  double late_s = 0, late_se_s = 0;  // the scans' stamps are late; the error is NaN where times mean nothing
  /// By how much the offset of the scans' clock differs between drives, of which each then has its own; 0: one will do.
  double late_spread_s = 0;
  /// By how much the rate of the scans' clock differs from that of the wheels', in the drive where most; 0: it does not show.
  double clock_rate = 0;
  Unknowns unknowns;  // each with its wide prior: what the drives show, whether it is used or not
  Information unknowns_covariance;
  FactorChoice choice;
  bool judged =
      false;  // the drives are long enough, and have turns, without which a mirror image would not show
  ScanCounts counts;
  std::vector<StretchResidual> residuals;  // of the stretches whose walls show the motion in both directions
  std::vector<Remark> remarks;
};

/// mirrored: the beams run the other way round than the scans say.
///
/// Throws astro::Error of a ScanProblem.
/// Cost    1 to 3 ms for each 0.4 m that were driven; memory for stretches, not for scans.
ScanCalibration calibrate_by_scans(std::span<const ScannedDrive> drives,
                                   const calibration::WheelFactors& loaded, bool mirrored = false);

}  // namespace astro::lidar
