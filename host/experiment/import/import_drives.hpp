#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/experiment/files/run_set.hpp"
#include "host/experiment/import/paired_drive.hpp"

/// Drives of any robot under any tracker, from the files of others to what calibrations take.
namespace astro::experiment {

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

struct ImportedDrives {
  /// Named after the files of the wheels, with their folders as far as needed to tell them apart.
  RunSet set;
  std::vector<DriveReport> reports;  // of each
};

/// Throws what read_wheels, read_truth and pair_up throw, and astro::Error if two pairs are the same files.
ImportedDrives import_drives(std::span<const DriveFiles> files, const ImportChoices& choices);

/// The same of drives whose truth comes from elsewhere: runs without truth.
ImportedDrives import_wheels(std::span<const std::filesystem::path> wheels, const ImportChoices& choices);

}  // namespace astro::experiment
