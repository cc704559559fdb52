#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "host/calibration/umbmark.hpp"
#include "host/link/parameter_row.hpp"

/// calib.toml, the result of a calibration on its way to the robot; and the file of `params export`. Both
/// keep what is to be loaded under [parameters], by table name and in SI units.
namespace astro::experiment {

using ParameterValues = std::map<std::string, link::Value>;

/// Writes an estimate: [parameters] c_R, c_L, b; [standard_errors]; [carried]; [calibration] with how it was
/// found.
void write_calibration(const std::filesystem::path& path, const calibration::Estimate& estimate);

/// Writes parameters alone.
void write_parameters(const std::filesystem::path& path, const ParameterValues& values);

struct ParameterFile {
  ParameterValues parameters;
  /// What the robot carried when the calibration was driven; empty in a file without [carried].
  std::map<std::string, double> carried;
};

/// Throws astro::Error naming the file, and the line where TOML knows it: no such file, not TOML, no
/// [parameters], a value that is neither number nor text.
ParameterFile read_parameter_file(const std::filesystem::path& path);

}  // namespace astro::experiment
