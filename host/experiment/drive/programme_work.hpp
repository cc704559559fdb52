#pragma once

#include <filesystem>

#include "host/experiment/files/plan.hpp"

/// Forecasts how long an experiment takes and how much floor it needs, so that a person knows it before the
/// robot drives.
namespace astro::experiment {

/// The runs of a plan that are not recorded in its folder yet.
struct ProgrammeWork {
  int all = 0, left = 0;  // runs
  double driving_s = 0;   // of those that are left
};
ProgrammeWork work_of(const Plan& plan, const std::filesystem::path& folder);

/// The rectangle that the middle of the axle covers in one phase, in the start pose's frame: metres ahead and
/// metres to the left. Each run begins where the one before ended. The robot is not calibrated yet, so the
/// field allows for wheels that differ by up to 0.5 % and a wheelbase that is wrong by up to 1 %, which turn
/// each square further about its start.
struct DrivenField {
  double from_ahead_m = 0, to_ahead_m = 0, from_left_m = 0, to_left_m = 0;
};
DrivenField field_of(const Plan& plan, double wheelbase_m);

}  // namespace astro::experiment
