#include "host/formats/cdr/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "host/base/error.hpp"

namespace astro::ros2 {
namespace {

/// Whether it is a digit of ASCII, whatever the locale.
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

bool is_word(std::string_view text) {
  return !text.empty() && is_letter(text[0]) &&
         std::all_of(text.begin(), text.end(), [](char c) { return is_letter(c) || is_digit(c); });
}

/// "/", then words with / between them.
bool is_absolute(std::string_view text) {
  if (text.empty() || text[0] != '/') return false;
  for (std::size_t begin = 1; begin <= text.size();) {
    const std::size_t end = std::min(text.find('/', begin), text.size());
    if (!is_word(text.substr(begin, end - begin))) return false;
    begin = end + 1;
  }
  return true;
}

constexpr const char* kWordRule =
    "has to be letters, digits and underscores, and must not begin with a digit";
constexpr const char* kPathRule = "it has to begin with a /, and what is between two of them ";

[[noreturn]] void refuse(std::string_view what, std::string_view text, const std::string& rule,
                         NameProblem problem = NameProblem::malformed) {
  throw Error(fmt::format("the {} is '{}': {}", what, text, rule), problem,
              {std::string(what), std::string(text)});
}

void require_length(std::string_view what, std::string_view text, std::size_t longest) {
  if (text.size() > longest)
    refuse(what, text, fmt::format("it must not have more than {} characters", longest),
           NameProblem::too_long);
}

std::string on_wire(std::string_view prefix, std::string_view name, std::string_view suffix) {
  require_length("name", name, kLongestTopicName);
  if (!is_absolute(name)) refuse("name", name, std::string(kPathRule) + kWordRule);
  return fmt::format("{}{}{}", prefix, name, suffix);
}

}  // namespace

bool is_full_name(std::string_view name) { return name.size() <= kLongestTopicName && is_absolute(name); }

NodeName valid(NodeName node) {
  require_length("name of the node", node.name, kLongestNodeName);
  if (!is_word(node.name)) refuse("name of the node", node.name, fmt::format("it {}", kWordRule));
  require_length("namespace", node.name_space, kLongestNamespace);
  if (node.name_space != "/" && !is_absolute(node.name_space))
    refuse("namespace", node.name_space, std::string(kPathRule) + kWordRule);
  return node;
}

std::string full_name(const NodeName& node) {
  return (node.name_space == "/" ? "" : node.name_space) + '/' + node.name;
}

std::string resolved(std::string_view name, const NodeName& node) {
  std::string absolute;
  if (name.starts_with('/'))
    absolute = name;
  else if (name.starts_with("~/"))
    absolute = full_name(node) + std::string(name.substr(1));
  else
    absolute = (node.name_space == "/" ? "" : node.name_space) + '/' + std::string(name);
  wire_name_of_topic(absolute);  // refuses what is no name
  return absolute;
}

std::string wire_name_of_topic(std::string_view name) { return on_wire("rt", name, ""); }
std::string wire_name_of_requests(std::string_view name) { return on_wire("rq", name, "Request"); }
std::string wire_name_of_replies(std::string_view name) { return on_wire("rr", name, "Reply"); }

}  // namespace astro::ros2
