#pragma once

#include <map>
#include <optional>
#include <string>
#include <variant>

namespace astro::experiment {

/// The number called `name`, for instance a parameter; nullopt if there is none.
inline std::optional<double> number_named(const std::map<std::string, double>& values,
                                          const std::string& name) {
  const auto found = values.find(name);
  return found == values.end() ? std::nullopt : std::optional(found->second);
}

/// Values of a file, which may also be text.
using NamedValues = std::map<std::string, std::variant<double, std::string>>;

/// The same where values may also be text; nullopt for text.
inline std::optional<double> number_named(const NamedValues& values, const std::string& name) {
  const auto found = values.find(name);
  const double* number = found == values.end() ? nullptr : std::get_if<double>(&found->second);
  return number == nullptr ? std::nullopt : std::optional(*number);
}

}  // namespace astro::experiment
