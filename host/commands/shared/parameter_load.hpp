#pragma once

#include <optional>
#include <vector>

#include "host/console/command_line.hpp"
#include "host/experiment/drive/change_guard.hpp"
#include "host/robot/parameters/upload.hpp"

namespace astro::commands {

struct LoadOptions {
  bool yes = false, force = false;
};

/// Adds --force to a command that uploads a calibration.
void add_force(console::Command command, bool& force);

/// Whether a calibration is to be loaded: asks at the terminal, unless `yes`. If its drives do not show that it is better, a
/// person at a terminal must agree, or both `force` and `yes` must be set. If it is worse, `force` must be set in any case.
bool agreed_to_load(calibration::Verdict verdict, const LoadOptions& options);

struct LoadResult {
  std::vector<robot::Change> changes;         // empty: the robot held these values already
  std::optional<robot::UploadReport> report;  // none without changes, and if a person declined
  bool declined = false;                      // nothing was loaded, because a person said no
  bool advised_against =
      false;  // nothing was loaded, because it is not better and nobody said otherwise; it was said
};

/// Loads the parameters of a file (a calibration or a robot's whole table) into the robot; the only function
/// that does so. Shows old and new values side by side, refuses what experiment::objections name, or warns of each with
/// `force`, warns about values far from the present ones, asks as agreed_to_load does, and uploads. Throws astro::Error if
/// nothing was loaded, unless a person who was asked declined or it is advised against.
LoadResult load_parameters(robot::Client& client, const robot::RemoteParameters& robot,
                           const experiment::ParameterFile& file, const LoadOptions& options);

/// For values that a person typed: shows before and after, warns about values far from the present ones, and
/// asks (unless `yes`) if there is such a value or if there are more changes than `unasked`. Returns false if
/// the person declines.
bool agreed(const robot::RemoteParameters& robot, const std::vector<robot::Change>& changes, bool yes,
            std::size_t unasked = 1);

/// Prints which of `changes` are far from the robot's present values; returns false if none is.
bool warn_of_far_changes(const robot::RemoteParameters& robot, const std::vector<robot::Change>& changes);

}  // namespace astro::commands
