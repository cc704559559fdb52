#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "host/import/drives/import_drives.hpp"

/// Which files belong to one drive, where nobody says it.
namespace astro::importing {

/// What a file can be of a drive; both if one bag or table holds wheels and ground truth.
struct OfferedFile {
  std::filesystem::path path;
  bool wheels = false, truth = false;
};

/// The drives, in the order of the names of their wheels, numbers by value: run 2 before run 10. A file that is both is a drive
/// of its own, unless all others are of one kind: then it is of the other kind, as a table of wheels with odometry beside them.
/// Wheels and ground truth go together that share the rarest words and numbers of their names ("run-01_odo.csv" and
/// "run-01_opti.csv.gz"); where the names share nothing that tells drives apart, they go together in the order of their names.
/// A drive for which no file is left lacks one of its paths.
std::vector<DriveFiles> pair_files(std::span<const OfferedFile> files);

}  // namespace astro::importing
