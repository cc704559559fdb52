#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "host/simulation/study/programme.hpp"

/// What a programme of drives will give, as text for people and as JSON.
namespace astro::commands {

/// At most 80 columns as long as not all four kinds come in hundreds.
std::string plan_text(const simulation::study::Forecast& forecast);

nlohmann::json plan_json(const simulation::study::Forecast& forecast);

/// What drives it and calibrates from it, to be typed as it stands.
std::vector<std::string> commands_for(const simulation::study::Programme& programme);

/// "8 min 47 s", "2 h 03 min".
std::string duration_text(double seconds);

}  // namespace astro::commands
