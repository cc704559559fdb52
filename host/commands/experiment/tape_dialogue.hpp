#pragma once

#include <optional>

#include "host/commands/shared/press_enter.hpp"
#include "host/experiment/drive/experiment.hpp"
#include "host/truth/manual/reading.hpp"

/// The questions of an experiment whose ground truth people enter, beside those for the numbers themselves.
namespace astro::commands {

/// The unit of numbers without one; an empty answer is mm.
truth::LengthUnit ask_length_unit(const AskLine& ask);

/// Waits for Enter alone: the robot stands on its mark for `next`. Where `last` is given, it can be corrected first.
experiment::Redo ask_ready(const AskLine& ask, const experiment::RunSpec& next,
                           const std::optional<experiment::RunSpec>& last);

/// After a run that was broken off: waits for Enter alone, the robot stands on its mark again.
void ask_put_back(const AskLine& ask, const experiment::RunSpec& run);

/// What to do about a run that does not fit the others.
experiment::Redo ask_about(const AskLine& ask, const experiment::DoubtfulRun& run);

}  // namespace astro::commands
