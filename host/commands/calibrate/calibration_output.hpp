#pragma once

#include <filesystem>

#include "host/console/command_line.hpp"
#include "host/experiment/analysis/calibration.hpp"

namespace astro::commands {

/// --out and --json of the commands that calibrate: where the result goes.
struct CalibrationOutput {
  std::filesystem::path file;  // empty: it is printed only
  bool json = false;
};
void add_output(console::Command command, CalibrationOutput& output);

/// Writes the calibration into its file, if one is named, and prints it as text or JSON.
void put_out(const experiment::Calibration& found, const CalibrationOutput& output);

}  // namespace astro::commands
