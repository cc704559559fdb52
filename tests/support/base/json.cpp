#include "tests/support/base/json.hpp"

#include <ostream>

namespace astro::support {

nlohmann::json parse_json(const std::string& text) { return nlohmann::json::parse(text); }

}  // namespace astro::support

namespace nlohmann {

void PrintTo(const json& value, std::ostream* out) { *out << value; }

}  // namespace nlohmann
