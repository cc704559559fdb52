#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "host/truth/live/tracker_watch.hpp"

namespace astro::commands {

/// One line of at most 120 columns.
std::string line_of(const truth::TrackerReport& report);
nlohmann::json to_json(const truth::TrackerReport& report);

}  // namespace astro::commands
