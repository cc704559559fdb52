#pragma once

#include <string>
#include <string_view>

#include "host/calibration/judgement/cross_validation.hpp"
#include "host/experiment/analysis/calibration.hpp"

/// Advice on whether to use new factors, in words that the terminal, the report and files share.
namespace astro::experiment {

/// The advice and the reason for it: "Better on 6 of 6 drives that it had not seen: the end error is 21 mm instead of 83 mm
/// ..., so use it.", or "Not better than what the robot carries: ... Keep what it carries."
std::string judgement_sentence(const calibration::CrossValidation& judgement);
/// The same of any method: of scans by the pieces of the drives that they were not found from.
std::string judgement_sentence(const Calibration& found);

/// By how much the robot changes from one day to another, and from what that is known.
std::string drift_sentence(const calibration::DayDrift& drift);

/// "better", "worse", "undecided", "unknown": for files and programs.
std::string_view name_of(calibration::Verdict verdict);
/// Any other name gives Verdict::unknown: a file of an older version has no verdict.
calibration::Verdict verdict_named(std::string_view name);

/// Whether the drives advise against loading the factors, because they are worse or not shown to be better.
bool advises_against(calibration::Verdict verdict);

}  // namespace astro::experiment
