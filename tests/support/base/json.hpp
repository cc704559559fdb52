#pragma once

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>

/// JSON in tests. Parser and printer are compiled once, in json.cpp: they are two seconds of every file that
/// makes them itself.
namespace astro::support {

/// Throws nlohmann::json::parse_error.
nlohmann::json parse_json(const std::string& text);

}  // namespace astro::support

namespace nlohmann {

/// How GoogleTest shows it where an expectation fails.
void PrintTo(const json& value, std::ostream* out);

}  // namespace nlohmann
