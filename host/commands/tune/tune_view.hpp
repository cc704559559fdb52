#pragma once

#include "host/commands/shared/robot_view.hpp"
#include "host/commands/tune/tune_job.hpp"
#include "host/report/tuning_report.hpp"

/// What `astrolabe tune` found, for a terminal, for scripts and for a browser.
namespace astro::commands {

/// Before anything is loaded: motors, gains, and the steps measured and predicted.
std::string in_words(const TuneResult& result);

/// The step with the loaded values, measured and predicted; "" if nothing was loaded.
std::string step_after_in_words(const TuneResult& result);

/// One sentence: whether the wheels follow their set point better, worse or about as well with the new
/// values, measured if they were loaded and else predicted.
std::string verdict(const TuneResult& result);

/// What gains cannot correct: one sentence each.
std::vector<std::string> notes(const TuneResult& result);

/// All of it, for scripts.
Json to_json(const TuneResult& result);

/// For a browser.
report::TuningInput report_input(const TuneResult& result, const robot::Client& client);

}  // namespace astro::commands
