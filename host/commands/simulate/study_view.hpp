#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "host/simulation/study/summary.hpp"

/// A study as text for people and as JSON.
namespace astro::commands {

/// At most 80 columns.
std::string study_text(const simulation::study::Summary& summary);

nlohmann::json study_json(const simulation::study::Summary& summary);

/// `value` with three significant digits and never an exponent: "421", "17.0", "2.36".
std::string three_digits(double value);

}  // namespace astro::commands
