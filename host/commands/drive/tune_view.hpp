#pragma once

#include "host/commands/shared/robot_view.hpp"
#include "host/motor/bench/tune_motors.hpp"
#include "host/report/tuning_report.hpp"
#include "host/robot/client/client.hpp"

/// What `astrolabe tune` found, for a terminal, for scripts and for a browser.
namespace astro::commands {

/// Before anything is loaded: motors, gains, and the steps measured and predicted.
std::string in_words(const motor::TuningResult& result);

/// The step with the loaded values, measured and predicted; "" if nothing was loaded.
std::string step_after_in_words(const motor::TuningResult& result);

/// One sentence: whether the wheels follow their set point better, worse or about as well with the new
/// values, measured if they were loaded and else predicted.
std::string verdict(const motor::TuningResult& result);

/// What gains cannot correct: one sentence each.
std::vector<std::string> notes(const motor::TuningResult& result);

/// All of it, for scripts.
Json to_json(const motor::TuningResult& result);

/// For a browser.
report::TuningInput report_input(const motor::TuningResult& result, const robot::Client& client);

}  // namespace astro::commands
