#pragma once

#include "host/cli/robot_view.hpp"
#include "host/cli/tune_job.hpp"
#include "host/report/tuning_report.hpp"

/// What `astrolabe tune` found, for a terminal, for scripts and for a browser.
namespace astro::cli {

/// Motors, gains and steps; the steps alone.
std::string in_words(const TuneResult& result);
std::string steps_in_words(const TuneResult& result);
Json to_json(const TuneResult& result);
report::TuningInput report_input(const TuneResult& result, const link::Client& client);

}  // namespace astro::cli
