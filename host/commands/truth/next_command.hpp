#pragma once

#include <filesystem>
#include <string>

#include "host/commands/shared/import_options.hpp"
#include "host/import/drives/file_inspection.hpp"

namespace astro::commands {

/// The command line that calibrates with this file, with the choices that were given to read it. Capitals stand for what the
/// file does not show: the other files of the drive, the sizes of the robot, and which of several bodies or topics is meant.
/// Empty if there is nothing in the file to calibrate with.
std::string next_command(const std::filesystem::path& path, const importing::FileInspection& found,
                         const ImportOptions& choices);

/// The same of a log of CARMEN.
std::string command_for_log(const std::filesystem::path& path);

}  // namespace astro::commands
