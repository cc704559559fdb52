#pragma once

#include <filesystem>

#include "host/experiment/files/plan.hpp"

/// How long an experiment takes, and how much floor: what a person wants to know before the robot drives.
namespace astro::experiment {

/// The runs of a plan that are not recorded in its folder yet.
struct ProgrammeWork {
  int all = 0, left = 0;  // runs
  double driving_s = 0;   // of those that are left
};
ProgrammeWork work_of(const Plan& plan, const std::filesystem::path& folder);

/// Where the middle of the axle goes in one phase, from where it stands at first and along the way that it
/// points to: metres ahead and metres to the left, one run behind the other. Nobody has calibrated the robot
/// yet: the field holds what it drives with wheels that differ by up to 0.5 % and a wheelbase that is up to 1 %
/// off, which turns each square further about its start.
struct DrivenField {
  double from_ahead_m = 0, to_ahead_m = 0, from_left_m = 0, to_left_m = 0;
};
DrivenField field_of(const Plan& plan, double wheelbase_m);

}  // namespace astro::experiment
