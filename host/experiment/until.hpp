#pragma once

#include <filesystem>
#include <string>

#include "host/calibration/precision.hpp"
#include "host/experiment/calibration.hpp"
#include "host/experiment/plan.hpp"

/// Driving until it is enough: how precise a calibration is, and how far a folder has got.
namespace astro::experiment {

/// Standard errors over values; NaN where the method cannot tell.
calibration::Precision precision_of(const Calibration& calibration);

/// All three are known and at most `target`.
bool reaches(const calibration::Precision& precision, double target);

/// "E_d ± 0.042 %, S ± 0.021 %, b ± 0.110 %"
std::string described(const calibration::Precision& precision);

/// Squares of a phase that are recorded in both directions without a gap.
int recorded_squares(const std::filesystem::path& folder, const Plan& plan, std::size_t phase);

/// How many squares a phase has in each direction: those planned, or those recorded where it is open-ended.
int squares_in_phase(const std::filesystem::path& folder, const Plan& plan, std::size_t phase);

/// Where a run of an experiment is kept.
std::filesystem::path file_of(const std::filesystem::path& folder, const RunSpec& spec);

/// The recordings of these runs, named like their files ("square-cw-3"). Throws what recording::read_run
/// throws.
RunSet read_specs(const std::filesystem::path& folder, const std::vector<RunSpec>& specs);

}  // namespace astro::experiment
