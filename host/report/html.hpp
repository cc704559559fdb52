#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

/// Escapes text so that it cannot become markup or script in a page.
namespace astro::report {

/// For element content and double-quoted attributes.
std::string escape(std::string_view text);

/// For the inside of <script type="application/json">: no character that could end the element is left.
/// Bytes that are not UTF-8 become U+FFFD; NaN becomes null.
std::string script_json(const nlohmann::json& value);

/// Replaces each {{name}} of the template in one pass, so a value is never searched for placeholders.
/// Throws std::out_of_range for a name without a value, which is a programming error.
std::string fill(std::string_view page, const std::map<std::string, std::string, std::less<>>& values);

/// "before" -> "Before".
std::string capitalised(std::string text);

}  // namespace astro::report
