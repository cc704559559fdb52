#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/calibration/gyro/gyro_drive.hpp"
#include "host/calibration/gyro/turn_regression.hpp"

/// Calibrates the gyro of a robot beside its wheels: scale, sign, bias and lag, from any recorded drives; and finds where the wheels
/// slipped by it.
namespace astro::calibration {

/// Why a gyro cannot be calibrated. Values: what there is.
enum class GyroProblem {
  no_rates,      // no drive in which the gyro and the wheels were recorded at the same time
  no_turns,      // the robot hardly turned
  nothing_alike  // the gyro does not turn as the wheels do
};

struct UnseenTurn {
  std::size_t drive = 0;
  Slip slip;
  Pose2 place;  // by the wheels, from the start of the drive
};

struct GyroBias {
  std::string drive;
  double radps = 0, se_radps = 0;  // at its end
};

/// What the gyro measured of the turn that the wheels did.
struct GyroAgainstWheels {
  /// The gyro's scale times the wheelbase of these factors over the true one: all that wheels and gyro show. Negative: it counts
  /// clockwise.
  double product = 1, product_se = 0;
  /// By how much c_R over c_L is larger than these factors say, relatively: on its way the robot turned without its wheels' knowing.
  double difference = 0, difference_se = 0;
  double lag_s = 0, lag_se_s = 0;  // from a motion to its reading, beyond that of the encoders
  std::vector<GyroBias> biases;    // of the drives that have rates
  TurnNoise noise;                 // slip_rad2pm: of the wheels
  std::vector<UnseenTurn> slips;   // in order of drives and times
  double chi_square = 0;
  int degrees_of_freedom = 0;
};

/// Compares the gyro with the wheels' turns by these factors. That one wheel may be larger than another than the factors say, by up
/// to a hundredth, is in the errors. Drives without rates do not count.
///
/// Throws astro::Error of a GyroProblem.
/// Cost    0.2 s for ten minutes.
GyroAgainstWheels compare_gyro(std::span<const GyroDrive> drives, const WheelFactors& factors);

struct GyroScale {
  double scale = 1, se = 0;  // the turn that it measures over the true turn; negative: it counts clockwise
  double chi_square = 0;
  int degrees_of_freedom = 0;
};

/// The gyro's scale by the headings of the drives' truth; nothing if no drive has any. `compared`: of the same drives.
std::optional<GyroScale> gyro_scale_by_truth(std::span<const GyroDrive> drives, const WheelFactors& factors,
                                             const GyroAgainstWheels& compared);

/// The robot's heading at a moment of a drive, on its clock, whole turns included: it has turned so far since the first one.
struct KnownHeading {
  double time_s = 0, heading_rad = 0;
};

struct GyroByHeadings {
  GyroScale scale;
  std::vector<GyroBias> biases;  // of the drives that count
};

/// The gyro's scale by a few headings of each drive, such as those of a robot that stands flush with a wall after whole turns. What it
/// turned in between is integrated; its bias is what the time shows, and is separated from the scale by turns both ways round.
/// `headings`: of each drive, in order of time and at rest. `heading_rad`: the standard error of each, known to a factor of two.
/// Nothing if the drives turn less than once.
std::optional<GyroByHeadings> gyro_scale_by_headings(std::span<const GyroDrive> drives,
                                                     std::span<const std::vector<KnownHeading>> headings,
                                                     double heading_rad, const GyroAgainstWheels& compared);

}  // namespace astro::calibration
