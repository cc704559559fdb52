#pragma once

#include <optional>
#include <vector>

#include "host/experiment/drive/change_guard.hpp"
#include "host/robot/parameters/upload.hpp"

namespace astro::commands {

struct LoadOptions {
  bool yes = false, force = false;
};

struct Loaded {
  std::vector<experiment::Change> changes;   // empty: the robot held these values already
  std::optional<robot::UploadReport> report;  // none without changes
};

/// Loads the parameters of a file, be it a calibration or a robot's whole table: the only way from a file to
/// the robot. Warns if it is of another robot, shows old and new side by side, refuses what
/// experiment::objection names unless `force`, warns of values far from the present ones, asks unless `yes`,
/// and uploads. Throws astro::Error if nothing was loaded.
Loaded load_parameters(robot::Client& client, const robot::RemoteParameters& robot,
                       const experiment::ParameterFile& file, const LoadOptions& options);

/// For values that are typed: shows before and after, warns of those far from the present ones, and asks,
/// unless `yes`, if there is one of these or if there are more changes than `unasked`. False: they are not
/// wanted.
bool agreed(const robot::RemoteParameters& robot, const std::vector<experiment::Change>& changes, bool yes,
            std::size_t unasked = 1);

/// Says which of `changes` are far from what the robot holds; false if none is.
bool warn_of_far_changes(const robot::RemoteParameters& robot, const std::vector<experiment::Change>& changes);

}  // namespace astro::commands
