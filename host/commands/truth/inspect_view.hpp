#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "host/experiment/import/file_inspection.hpp"

namespace astro::commands {

/// What is in a file, as text of at most 120 columns.
std::string inspection_text(const experiment::FileInspection& found);
nlohmann::json to_json(const experiment::FileInspection& found);

}  // namespace astro::commands
