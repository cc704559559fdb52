#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "host/experiment/analysis/calibration.hpp"
#include "host/robot/parameters/parameter_row.hpp"

/// calib.toml, the result of a calibration on its way to the robot; and the file of `params export`. Both
/// keep what is to be loaded under [parameters], by table name and in SI units.
namespace astro::experiment {

/// The text of the first line of a file with factors.
inline constexpr const char* kFoundFactors = "Found by Astrolabe, to be uploaded to the robot that drove.";

using ParameterValues = std::map<std::string, robot::Value>;

/// Writes [parameters] c_R, c_L, b, e, kappa0; [standard_errors] and, where S is known, [covariance], both on another day; from
/// maximum likelihood [slip];
/// [nominal], the wheel that c_R and c_L refer to (without counts if the recordings had none), and [robot], where they are known;
/// [carried]; [calibration] with how it was found; [verdict] whether it is better.
void write_calibration(const std::filesystem::path& path, const Calibration& calibration);

/// Writes parameters alone.
void write_parameters(const std::filesystem::path& path, const ParameterValues& values);

struct ParameterFile {
  ParameterValues parameters;
  /// The factors loaded in the robot when the calibration was driven; empty in a file without [carried].
  std::map<std::string, double> loaded;
  /// Of c_R, c_L, b and e. NaN if the method or the data do not determine it; empty in a file that no calibration wrote.
  std::map<std::string, double> standard_errors;
  /// The parameters are right whatever is loaded in the robot by now (Calibration::absolute).
  bool absolute = false;
  std::optional<NominalWheel> wheel;  // [nominal]
  /// Of c_R, c_L, b and e; that of e is zero in a file of an older version, which had no e; none in a file without
  /// [covariance].
  std::optional<calibration::FactorCovariance> covariance;
  /// Variance of a wheel's slip for each metre that it turns, m^2/m; none in a file without [slip].
  std::optional<double> slip_K_m;
  RobotIdentity robot;                                           // [robot]
  std::string method;                                            // "" in a file that no calibration wrote
  calibration::Verdict verdict = calibration::Verdict::unknown;  // [verdict]
  std::string verdict_sentence;                                  // "" in a file without one
};

/// Without a measured length S is as loaded, with the error of a nominal wheel: radius of a tyre, load and pressure.
inline constexpr double kErrorOfNominalScale = 0.005;

/// [covariance], or what [standard_errors] say of c_R, c_L and b where S is as loaded: E_d and b / S, and kErrorOfNominalScale. None
/// without either.
std::optional<calibration::FactorCovariance> covariance_in(const ParameterFile& file);

/// Writes a file that read_parameter_file can read. For results that are no Calibration, because they were not found from
/// recordings.
void write_parameter_file(const std::filesystem::path& path, const ParameterFile& file);

/// Throws astro::Error naming the file, and the line where TOML knows it: no such file, cut off, not TOML, no
/// [parameters], a value that is neither number nor text, a damaged [covariance] or [nominal].
ParameterFile read_parameter_file(const std::filesystem::path& path);

}  // namespace astro::experiment
