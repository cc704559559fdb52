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

/// Drives of any robot under any tracker, from the files of others to what calibrations take.
namespace astro::importing {

/// The two files of a drive; of a bag that holds both, the same path.
struct DriveFiles {
  std::filesystem::path wheels, truth;
};

/// What a person says about all of them.
struct ImportChoices {
  WheelSelection wheels;
  TruthSelection truth;
  RobotGeometry geometry;
  truth::FloorChoices floor;
};

/// What was found in the files of a drive.
struct DriveReport {
  truth::FloorFindings floor;
  std::string summary;          // how many samples, how often, whose poses, what is up: one phrase
  std::vector<Remark> remarks;  // what was inferred or left out, of both files
};

struct ImportedDrives {
  /// Named after the files of the wheels, with their folders as far as needed to tell them apart.
  experiment::RunSet set;
  std::vector<DriveReport> reports;  // of each
};

/// Throws astro::Error if two pairs are the same files; naming the drive if wheels and truth turn against each other, or the body is
/// below the origin of an axis that was not given; if a wheel turns 100 times between two samples, or leaps faster than 20 m/s; naming the
/// bag if a description in it has the wheels and not their sizes; and what read_wheels, read_truth, complete_geometry and
/// truth::place_on_floor throw.
ImportedDrives import_drives(std::span<const DriveFiles> files, const ImportChoices& choices);

/// The same of drives whose truth comes from elsewhere: runs without truth.
ImportedDrives import_wheels(std::span<const std::filesystem::path> wheels, const ImportChoices& choices);

}  // namespace astro::importing
