#include "host/commands/live/ros_arguments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>

#include "host/base/bytes.hpp"
#include "host/base/error.hpp"
#include "host/base/files.hpp"
#include "host/base/text/numbers.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/formats/files/yaml_scalars.hpp"
#include "host/live/driver/parameter_table.hpp"

namespace astro::commands {
namespace {

using bag::YamlScalar;
using live::ParameterType;

constexpr std::string_view kAssign = ":=";
constexpr std::size_t kMostBytes = 1 << 20;  // of a file of parameters

[[noreturn]] void refuse(std::string_view flag, const std::string& what) {
  throw console::WrongUsage(fmt::format("--ros-args: {} {}", flag, what));
}

/// [NODE:]LEFT:=RIGHT
struct Rule {
  std::string node;  // "": any
  std::string left, right;
};

Rule rule_in(const std::string& flag, const std::string& word) {
  const std::size_t assign = word.find(kAssign);
  if (assign == std::string::npos || assign == 0 || assign + kAssign.size() == word.size())
    refuse(flag, fmt::format("'{}' is not FROM:=TO", word));
  Rule rule{"", word.substr(0, assign), word.substr(assign + kAssign.size())};
  // A name may begin with its kind. It is not needed here, because no topic has the name of a service.
  for (const std::string_view scheme : {"rostopic://", "rosservice://"})
    if (rule.left.starts_with(scheme)) rule.left.erase(0, scheme.size());
  if (const std::size_t colon = rule.left.find(':'); colon != std::string::npos) {
    rule.node = rule.left.substr(0, colon);
    rule.left.erase(0, colon + 1);
  }
  if (rule.left.empty()) refuse(flag, fmt::format("'{}' is not FROM:=TO", word));
  return rule;
}

std::optional<bool> truth_in(std::string_view word) {
  constexpr std::array kTrue{"y", "Y", "yes", "Yes", "YES", "true", "True", "TRUE", "on", "On", "ON"};
  constexpr std::array kFalse{"n", "N", "no", "No", "NO", "false", "False", "FALSE", "off", "Off", "OFF"};
  if (std::ranges::find(kTrue, word) != kTrue.end()) return true;
  if (std::ranges::find(kFalse, word) != kFalse.end()) return false;
  return std::nullopt;
}

std::optional<std::int64_t> whole_in(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

ros2::msg::ParameterValue value_of(const YamlScalar& scalar) {
  ros2::msg::ParameterValue value;
  const auto become = [&](ParameterType type) { value.type = static_cast<std::uint8_t>(type); };
  const auto truth = truth_in(scalar.value);
  const auto whole = whole_in(scalar.value);
  const auto real = number_in(scalar.value);
  if (truth && !scalar.quoted) {
    become(ParameterType::boolean);
    value.bool_value = *truth;
  } else if (whole && !scalar.quoted) {
    become(ParameterType::integer);
    value.integer_value = *whole;
  } else if (real && !scalar.quoted) {
    become(ParameterType::real);
    value.double_value = *real;
  } else {
    become(ParameterType::text);
    value.string_value = scalar.value;
  }
  return value;
}

std::vector<std::string> split(std::string_view text, char between) {
  std::vector<std::string> parts;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(between), text.size());
    if (end > 0) parts.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return parts;
}

/// Whether the words of a name from `at` on match those of a pattern from `of` on.
bool fits(const std::vector<std::string>& name, std::size_t at, const std::vector<std::string>& pattern,
          std::size_t of) {
  if (of == pattern.size()) return at == name.size();
  if (pattern[of] == "**") {
    for (std::size_t next = at; next <= name.size(); ++next)
      if (fits(name, next, pattern, of + 1)) return true;
    return false;
  }
  return at < name.size() && (pattern[of] == "*" || pattern[of] == name[at]) &&
         fits(name, at + 1, pattern, of + 1);
}

bool is_of_node(const std::vector<std::string>& name, const std::vector<std::string>& pattern) {
  constexpr std::size_t kMostWords = 32;
  return pattern.size() <= kMostWords && fits(name, 0, pattern, 0);
}

class Reader {
 public:
  Reader(const std::vector<std::string>& words, const ros2::NodeName& otherwise) : words_(words) {
    found_.node = otherwise;
  }

  RosArguments read() {
    for (at_ = 0; at_ < words_.size(); ++at_) sort(words_[at_]);
    name_node();
    for (const Rule& rule : remaps_)
      if (!rule.left.starts_with("__") && concerns(rule)) rename(rule);
    for (const Source& source : sources_)
      source.is_file ? take_file(source.words) : take_assignment(rule_in("-p", source.words));
    return std::move(found_);
  }

 private:
  struct Source {
    bool is_file;
    std::string words;
  };

  const std::string& value(const std::string& flag) {
    if (++at_ == words_.size()) refuse(flag, "needs a value");
    return words_[at_];
  }

  void sort(const std::string& flag) {
    constexpr std::array kAlone{"--enable-rosout-logs",       "--disable-rosout-logs",
                                "--enable-stdout-logs",       "--disable-stdout-logs",
                                "--enable-external-lib-logs", "--disable-external-lib-logs"};
    constexpr std::array kWithValue{"--log-level", "--log-config-file", "--log-file-name", "--enclave", "-e"};
    if (flag == "-r" || flag == "--remap")
      remaps_.push_back(rule_in(flag, value(flag)));
    else if (flag == "-p" || flag == "--param")
      sources_.push_back({false, value(flag)});
    else if (flag == "--params-file")
      sources_.push_back({true, value(flag)});
    else if (std::ranges::find(kWithValue, flag) != kWithValue.end())
      value(flag);
    else if (std::ranges::find(kAlone, flag) == kAlone.end())
      refuse("knows no", fmt::format("'{}'", flag));
  }

  bool concerns(const Rule& rule) const { return rule.node.empty() || rule.node == found_.node.name; }

  const Rule* first(std::string_view left, std::string_view or_left = "") const {
    const auto found = std::ranges::find_if(remaps_, [&](const Rule& rule) {
      return (rule.left == left || rule.left == or_left) && concerns(rule);
    });
    return found == remaps_.end() ? nullptr : &*found;
  }

  void name_node() {
    if (const Rule* rule = first("__node", "__name")) found_.node.name = rule->right;
    if (const Rule* rule = first("__ns")) found_.node.name_space = rule->right;
    try {
      ros2::valid(found_.node);
    } catch (const Error& error) {
      refuse("-r:", error.what());
    }
  }

  void rename(const Rule& rule) {
    try {
      found_.renamed.push_back(
          {ros2::resolved(rule.left, found_.node), ros2::resolved(rule.right, found_.node)});
    } catch (const Error& error) {
      refuse("-r:", error.what());
    }
  }

  void take(const std::string& name, const ros2::msg::ParameterValue& value) {
    const auto known = std::ranges::find(found_.parameters, name, &ros2::msg::Parameter::name);
    if (known == found_.parameters.end())
      found_.parameters.push_back({name, value});
    else
      known->value = value;
  }

  void take_assignment(const Rule& rule) {
    if (!concerns(rule)) return;
    std::vector<YamlScalar> scalars;
    try {
      scalars = bag::yaml_scalars(rule.right, rule.left);
    } catch (const Error& error) {
      refuse("-p", fmt::format("'{}:={}': {}", rule.left, rule.right, error.what()));
    }
    // Lists are ignored, because no node here has a list as a parameter.
    if (scalars.size() == 1 && scalars[0].path.empty()) take(rule.left, value_of(scalars[0]));
  }

  void take_file(const std::string& path) {
    constexpr std::string_view kMarker = "/ros__parameters/";
    const std::vector<std::string> name = split(ros2::full_name(found_.node), '/');
    for (const YamlScalar& each :
         bag::yaml_scalars(as_text(load_file(path, kMostBytes)), '\'' + path + '\'')) {
      const std::size_t marker = each.path.find(kMarker);
      if (marker == std::string::npos || !is_of_node(name, split(each.path.substr(0, marker), '/'))) continue;
      std::string key = each.path.substr(marker + kMarker.size());
      std::ranges::replace(key, '/', '.');
      take(key, value_of(each));
    }
  }

  const std::vector<std::string>& words_;
  std::size_t at_ = 0;
  std::vector<Rule> remaps_;
  std::vector<Source> sources_;
  RosArguments found_;
};

}  // namespace

RosArguments ros_arguments(const std::vector<std::string>& words, const ros2::NodeName& otherwise) {
  return Reader(words, otherwise).read();
}

}  // namespace astro::commands
