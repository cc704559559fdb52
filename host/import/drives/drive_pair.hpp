#pragma once

#include <optional>
#include <string>

#include "host/import/drives/import_drives.hpp"
#include "host/import/drives/recorded_sizes.hpp"
#include "host/recording/run.hpp"

namespace astro::importing {

/// A drive whose wheels and whose ground truth other programs recorded.
struct PairedDrive {
  /// Like our own recordings: its odometry is dead reckoning with the factors of the geometry, its truth is
  /// the path on the floor, each with the times of its own clock ("tracker"). Angles and metres of travel are
  /// counts with kAngleCounts in a turn (analysis/trajectories.hpp).
  recording::Run run;
  DriveReport report;
  std::optional<double> counter_range;  // that the wheels showed
};

/// Reads both files of a drive and pairs them. If the wheels turn the robot in the direction opposite to the truth, one of four
/// things is wrong, and the motion alone cannot show which: the up axis is reversed, left and right wheel are exchanged, both
/// encoders are reversed (they count backward then), or the recording is a mirror image. Trackers have their origin on the floor,
/// so a body clearly below the origin shows that the axis is reversed. Otherwise nothing is guessed, because with exchanged wheels
/// the right wheel would get the left factor. If both turn alike but the body is below the origin, two of the three may be wrong
/// and hide each other, so the axis must be given.
///
/// Throws astro::Error as import_drives does for one drive; errors of pairing name both files.
PairedDrive paired(const std::string& name, const DriveFiles& files, const ImportChoices& choices,
                   RecordedSizes& geometry);

/// Pairs wheels and ground truth that were read already. `files` is how messages call them.
PairedDrive pair_up(const std::string& name, const DriveFiles& files, ImportedWheels wheels,
                    const ImportedTruth& truth, const RobotGeometry& given, const ImportChoices& choices);

}  // namespace astro::importing
