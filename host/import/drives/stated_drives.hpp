#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/import/drives/import_drives.hpp"

/// Drives as a person names them, on a command line or in a page: which files, and in words how to read them.
namespace astro::importing {

/// What is wrong with a statement itself. Values: of not_paired how many files of wheels and of ground truth there are; of
/// unknown_axis and unknown_unit the word; of size_beyond_limits its name, its value and both limits.
enum class StatementProblem {
  not_paired,
  unknown_axis,
  unknown_unit,
  joints_not_paired,
  frames_not_two,
  size_beyond_limits
};

/// From the least to the most that is taken for a size of a robot.
struct Limits {
  double least = 0, most = 0;
};
inline constexpr Limits kWheelDiameterLimits_m{0.005, 5}, kWheelbaseLimits_m{0.02, 10},
    kCountsPerTurnLimits{1, 1e8}, kCounterRangeLimits{2, 1e15};
/// The units that can be stated of positions.
inline constexpr const char* kTruthUnits[] = {"m", "cm", "mm"};

/// Each member that is empty is left open: it is recognised in the files, or an error asks for it.
struct StatedDrives {
  std::vector<std::filesystem::path> wheels, truth;  // of each drive
  WheelTable table;
  std::string wheels_topic, truth_topic;  // of bags
  std::string imu_topic, imu_axis;        // of bags; the axis as axis_named takes it
  std::string wheels_unit;                // a name of travel_measures()
  std::string truth_columns, body;
  std::string up;                   // as axis_named takes it
  std::string unit;                 // of ground truth: one of kTruthUnits
  std::string mirrored = "auto";    // "yes", "no"
  std::string controller;           // in a robot_file with several
  std::vector<std::string> joints;  // left and right, each "front+rear" if there are several on a side
  std::vector<std::string> frames;  // parent and child
  bool swap_wheels = false, reverse_wheels = false, drives_backward = false;
  std::filesystem::path robot_file;                                      // as read_robot_file takes it
  std::optional<double> wheel_diameter_m, counts_per_turn, wheelbase_m;  // over those of the file
};

/// "y", "-z", or three numbers between commas. Nothing for any other word, and for 0,0,0.
std::optional<truth::Direction3> axis_named(std::string_view text);

/// What import_drives takes. Throws astro::Error with a StatementProblem, and what read_robot_file throws.
ImportChoices choices_of(const StatedDrives& drives);

/// The two files of each drive. Throws astro::Error with StatementProblem::not_paired if one is without wheels or ground truth.
std::vector<DriveFiles> drive_files(const StatedDrives& drives);

/// Reads them. Throws astro::Error with StatementProblem::not_paired if one is without wheels or ground truth, UnusedChoice
/// (unused_choice.hpp), and what choices_of and import_drives throw.
ImportedDrives import_stated(const StatedDrives& drives);

}  // namespace astro::importing
