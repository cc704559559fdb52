#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/experiment/files/run_set.hpp"
#include "host/import/drives/robot_geometry.hpp"
#include "host/import/drives/truth_file.hpp"
#include "host/import/drives/wheel_file.hpp"
#include "host/truth/floor/floor_path.hpp"

/// Imports drives of any robot under any tracker, from files of other programs into what calibrations take.
namespace astro::importing {

/// The two files of a drive; the same path twice if one bag holds both.
struct DriveFiles {
  std::filesystem::path wheels, truth;
};

/// What a person states about all drives.
struct ImportChoices {
  WheelSelection wheels;
  TruthSelection truth;
  RobotGeometry geometry;
  truth::FloorChoices floor;
  bool drives_backward = false;  // the robot did drive backward
};

/// What was found in the files of a drive.
struct DriveReport {
  truth::FloorFindings floor;
  std::string summary;          // how many samples, how often, whose poses, what is up: one phrase
  std::vector<Remark> remarks;  // what was inferred or left out in both files
};

struct ImportedDrives {
  /// The runs are named after the files of the wheels, with as many parent folders as make the names
  /// distinct.
  experiment::RunSet set;
  std::vector<DriveReport> reports;  // one for each run
};

/// What one drive does not show is taken from the others: which axis points up, and the range of a counter.
///
/// Throws astro::Error
///   if two pairs have the same file of wheels, or one drive is a copy of another;
///   naming the drive, if a wheel cannot be what it is said to be (wheel_doubts.hpp), or if by its wheels the robot drove
///   backward in all drives; if wheels and truth turn in opposite directions, if the body is below the origin along
///   an axis that was not given, if a wheel turns 100 times between two samples, or if it leaps faster than
///   20 m/s;
///   naming the bag, if a description in it has the wheels but not their sizes, or if the truth is the
///   odometry from which the wheels were worked out;
/// and what read_wheels, read_truth, complete_geometry and truth::place_on_floor throw.
ImportedDrives import_drives(std::span<const DriveFiles> files, const ImportChoices& choices);

/// The same for drives whose truth comes from elsewhere; the runs have no truth.
ImportedDrives import_wheels(std::span<const std::filesystem::path> wheels, const ImportChoices& choices);

/// A drive that is in memory: what another program of this process measured.
struct HeldDrive {
  std::string name;
  ImportedWheels wheels;
  truth::BodyTrack truth;
};

/// The same for such drives. Throws astro::Error naming the drive also if it has fewer than two samples of wheels or of ground
/// truth, or if their times do not increase.
ImportedDrives import_held(std::vector<HeldDrive> held, const ImportChoices& choices);

}  // namespace astro::importing
