#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "host/commands/shared/press_enter.hpp"
#include "host/experiment/drive/experiment.hpp"
#include "host/experiment/files/plan.hpp"
#include "host/truth/source/reading.hpp"

/// The dialogue with a person who enters ground truth from a tape measure, except the questions for the numbers themselves.
namespace astro::commands {

/// Before the first run: how many runs and readings are left in `folder`, how long they take, and a drawing of where to put the
/// tape. Lines of at most 80 columns.
std::string tape_briefing(const experiment::Plan& plan, const std::filesystem::path& folder);

/// The unit of numbers without one; an empty answer is mm.
truth::LengthUnit ask_length_unit(const AskLine& ask);

/// Waits for Enter alone, by which the person confirms that the robot stands on its mark for `next`. If `last` is given,
/// that run can be corrected first.
experiment::Redo ask_ready(const AskLine& ask, const experiment::RunSpec& next,
                           const std::optional<experiment::RunSpec>& last);

/// After a run that was broken off: waits for Enter alone, by which the person confirms that the robot stands on its mark
/// again.
void ask_put_back(const AskLine& ask, const experiment::RunSpec& run);

/// What to do about a run that does not fit the others.
experiment::Redo ask_about(const AskLine& ask, const experiment::DoubtfulRun& run);

}  // namespace astro::commands
