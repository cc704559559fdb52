#pragma once

#include <string>
#include <vector>

#include "host/base/remedy.hpp"
#include "host/experiment/import/robot_geometry.hpp"
#include "host/experiment/import/truth_file.hpp"
#include "host/experiment/import/wheel_file.hpp"
#include "host/recording/run/run.hpp"
#include "host/truth/floor/floor_path.hpp"

namespace astro::experiment {

/// What was found in the files of a drive.
struct DriveReport {
  truth::FloorFindings floor;
  std::string summary;          // how many samples, how often, whose poses, what is up: one phrase
  std::vector<Remark> remarks;  // what was inferred or left out, of both files
};

/// A drive whose wheels and whose ground truth other programs recorded.
struct PairedDrive {
  /// As our own recordings: dead reckoning with the factors of the geometry as odometry, and the path on the floor as
  /// truth, each with the times of its own clock ("tracker"). Angles and metres of travel are counts of kAngleCounts
  /// for a turn (analysis/trajectories.hpp).
  recording::Run run;
  DriveReport report;
};

/// Puts both together. Where the wheels turn the robot the other way than the ground truth does, one of three things is
/// wrong, and the motion alone cannot show which: the up axis, left and right wheel, or the recording is a mirror image. The
/// height of the body above the origin decides if it is clear, because trackers have their origin on the floor: below it,
/// the axis was reversed. Otherwise nothing is guessed, because exchanged wheels would give the left factor to the
/// right wheel. Where both turn alike but the body is below the origin, two of the three may be wrong and hide each other,
/// so the axis must be given.
///
/// Throws astro::Error: wheels and truth turn against each other, or the body is below the origin of an axis that was
/// not given; a wheel turns 100 times between two samples, or leaps faster than 20 m/s; what
/// complete_geometry and truth::place_on_floor throw.
PairedDrive pair_up(const std::string& name, ImportedWheels wheels, const ImportedTruth& truth,
                    const RobotGeometry& geometry, const truth::FloorChoices& choices = {});

}  // namespace astro::experiment
