#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "host/simulation/study/programme.hpp"

/// The forecast for a programme of drives, as text and as JSON.
namespace astro::commands {

/// At most 80 columns, unless all four kinds have hundreds of runs.
std::string plan_text(const simulation::study::Forecast& forecast);

nlohmann::json plan_json(const simulation::study::Forecast& forecast);

/// The commands that drive the programme and calibrate from it.
std::vector<std::string> commands_for(const simulation::study::Programme& programme);

/// "8 min 47 s", "2 h 03 min".
std::string duration_text(double seconds);

}  // namespace astro::commands
