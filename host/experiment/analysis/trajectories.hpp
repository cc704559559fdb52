#pragma once

#include <string>
#include <vector>

#include "host/calibration/motion/trajectory.hpp"
#include "host/experiment/files/run_set.hpp"
#include "host/recording/run.hpp"

/// From recordings to the trajectories that maximum likelihood takes.
namespace astro::experiment {

/// The counts of a turn if a recording has angles or metres instead of counts: so many that rounding is negligible.
inline constexpr double kAngleCounts = 0x1p24;

/// The wheels as the robot's parameters describe them, without c_R and c_L.
struct NominalWheel {
  double diameter_m = 0;
  double counts_per_turn = 0;  // of the wheel: encoder counts times gear ratio
  bool operator==(const NominalWheel&) const = default;

  /// The recording has no counts, because its source has already converted them to angles.
  bool turns_as_angle() const { return counts_per_turn == kAngleCounts; }

  /// Travel of a wheel with c = 1.
  double metres_per_count() const;
  /// Whether both give the same travel for the same rotation, so that c_R and c_L of one are right for the other. Compares
  /// the travel per count or, if one of them has no counts, the diameters.
  bool measures_like(const NominalWheel& other) const;
  /// "a wheel of 0.084 m with 2796.8 counts a turn".
  std::string described() const;
};

/// Throws astro::Error, in which the run is called `name`, if the recording does not name its wheel.
NominalWheel nominal_wheel(const recording::RunInfo& info, const std::string& name);

/// Whether truth was measured with its times while the robot moved: by cameras, in contrast to a tape measure
/// and to files that give only both ends.
bool has_moving_truth(const recording::RunInfo& info);

/// The wheels of a run of any kind. Times are seconds since its first odometry sample; travel comes from the counts, in which the robot
/// has applied its encoder polarity and which may wrap. Throws astro::Error, calling the run `name`: no odometry, times that run
/// backwards (the robot restarted), a recording that does not name the nominal wheel.
std::vector<calibration::WheelSample> wheels_of(const recording::Run& run, const std::string& name);

/// A run of any kind, both of whose clocks begin with its first odometry sample; truth samples that are not valid are left out.
///
/// Throws astro::Error as wheels_of does, and if it has no moving truth.
calibration::Trajectory trajectory_of(const recording::Run& run, const std::string& name);

/// All of them, with the slips that their robots' gyros show. Throws astro::Error also as require_comparable does.
std::vector<calibration::Trajectory> trajectories_of(const RunSet& set);

/// The same where the first runs of the set are converted already: appends the others to `trajectories`.
void extend_trajectories(std::vector<calibration::Trajectory>& trajectories, const RunSet& set);

/// Throws astro::Error unless both recordings are of the same robot with the same nominal wheels: common
/// factors would mean nothing otherwise.
void require_comparable(const recording::RunInfo& a, const std::string& a_name, const recording::RunInfo& b,
                        const std::string& b_name);

}  // namespace astro::experiment
