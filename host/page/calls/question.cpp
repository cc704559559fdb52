#include "host/page/calls/question.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/base/error.hpp"

namespace astro::page {
namespace {

using nlohmann::json;

/// Null if it is missing; a member that is there and null is of the wrong type.
const json* member(const json& question, const char* name) {
  const auto found = question.find(name);
  return found == question.end() ? nullptr : &*found;
}

}  // namespace

std::string text_in(const json& question, const char* name) {
  const json* value = member(question, name);
  if (value == nullptr) return "";
  if (!value->is_string()) throw Error(fmt::format("{} is no text", name));
  return value->get<std::string>();
}

std::optional<double> number_in(const json& question, const char* name) {
  const json* value = member(question, name);
  if (value == nullptr) return std::nullopt;
  if (!value->is_number()) throw Error(fmt::format("{} is no number", name));
  return value->get<double>();
}

std::optional<double> number_in(const json& question, const char* name, double least, double most) {
  const auto value = number_in(question, name);
  if (value && !(*value >= least && *value <= most))
    throw Error(fmt::format("{} is {}, and must be from {} to {}", name, *value, least, most));
  return value;
}

bool flag_in(const json& question, const char* name) {
  const json* value = member(question, name);
  if (value == nullptr) return false;
  if (!value->is_boolean()) throw Error(fmt::format("{} is neither true nor false", name));
  return value->get<bool>();
}

std::vector<std::string> texts_in(const json& question, const char* name) {
  const json* value = member(question, name);
  if (value == nullptr) return {};
  std::vector<std::string> texts;
  if (!value->is_array()) throw Error(fmt::format("{} is no list", name));
  for (const json& each : *value) {
    if (!each.is_string()) throw Error(fmt::format("{} has an entry that is no text", name));
    texts.push_back(each.get<std::string>());
  }
  return texts;
}

std::filesystem::path file_in(const std::filesystem::path& folder, const std::string& name) {
  const std::filesystem::path path(name);
  const bool plain =
      !name.empty() && name.find('\0') == name.npos && path == path.filename() && name != "." && name != "..";
  if (name == kMade) throw Error("'" + name + "' is where results are kept: rename the file");
  if (!plain) throw Error("'" + name + "' is no name of a file: give one without folders");
  return folder / path;
}

}  // namespace astro::page
