#include "host/console/options.hpp"

#include <fmt/format.h>

#include "host/base/text/numbers.hpp"

namespace astro::console {
namespace {

template <class Accept>
Check number(Accept accept, const std::string& allowed) {
  return [=](std::string& text) -> std::string {
    const auto value = typed_number(text);
    if (value && accept(*value)) return {};
    return fmt::format("'{}' is not {}", text, allowed);
  };
}

}  // namespace

Check between(double least, double greatest, const std::string& unit) {
  const std::string limits =
      fmt::format("a number from {:g} to {:g}{}{}", least, greatest, unit.empty() ? "" : " ", unit);
  return number([=](double value) { return value >= least && value <= greatest; }, limits);
}

Check positive(const std::string& unit) {
  const std::string allowed = unit.empty() ? "a number above 0" : "a number above 0 (in " + unit + ")";
  return number([](double value) { return value > 0; }, allowed);
}

Check whole(std::uint64_t least, std::uint64_t greatest) {
  return [=](std::string& text) -> std::string {
    const auto value = unsigned_in(text);
    if (value && *value >= least && *value <= greatest) return {};
    return fmt::format("'{}' is not a whole number from {} to {}", text, least, greatest);
  };
}

Check finite() {
  return number([](double) { return true; }, "a number");
}

Check fraction() {
  return [](std::string& text) -> std::string {
    const bool percent = text.ends_with('%');
    const auto value = typed_number(percent ? text.substr(0, text.size() - 1) : text);
    if (!value || *value <= 0) return fmt::format("'{}' is not like 0.05% or 0.0005", text);
    text = fmt::format("{}", percent ? *value / 100 : *value);
    return {};
  };
}

Option add_ranged(Command command, const std::string& names, double& value, const std::string& what,
                  const std::string& type_name, double least, double greatest, const std::string& unit) {
  return command.add_option(names, value, what)
      .type_name(type_name)
      .check(between(least, greatest, unit))
      .capture_default_str();
}

void examples(Command command, std::initializer_list<const char*> lines) {
  std::string footer = "\nExamples:";
  for (const char* line : lines) footer += std::string("\n  ") + line;
  command.footer(footer);
}

}  // namespace astro::console
