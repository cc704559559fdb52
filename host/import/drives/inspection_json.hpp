#pragma once

#include <nlohmann/json_fwd.hpp>

#include "host/import/drives/file_inspection.hpp"

namespace astro::importing {

/// What is in a file, for programs and for the page; sizes and axes that are not known are null.
nlohmann::json inspection_json(const FileInspection& found);

}  // namespace astro::importing
