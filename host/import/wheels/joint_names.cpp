#include "host/import/wheels/joint_names.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "common/base/side.hpp"

namespace astro::importing {
namespace {

/// The words of a name in lower case: "leftWheel_joint1" has left, wheel, joint and 1.
std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words;
  char before = ' ';
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    const bool alphabetic = std::isalpha(byte) != 0, digit = std::isdigit(byte) != 0;
    const auto last = static_cast<unsigned char>(before);
    const bool starts =
        (alphabetic && (std::isalpha(last) == 0 || (std::isupper(byte) != 0 && std::islower(last) != 0))) ||
        (digit && std::isdigit(last) == 0);
    if (starts) words.emplace_back();
    if (alphabetic || digit) words.back() += static_cast<char>(std::tolower(byte));
    before = c;
  }
  return words;
}

std::optional<Side> side_of(const std::string& word) {
  static const std::map<std::string, Side> sides = {
      {"left", Side::left},   {"l", Side::left},  {"lhs", Side::left},  {"port", Side::left},
      {"right", Side::right}, {"r", Side::right}, {"rhs", Side::right}, {"starboard", Side::right}};
  const auto found = sides.find(word);
  return found == sides.end() ? std::nullopt : std::optional(found->second);
}

bool speaks_of_wheels(const std::string& words) {
  for (const char* word : {"wheel", "tyre", "tire", "drive", "motor"})
    if (words.find(word) != std::string::npos) return true;
  return false;
}

/// The name with a placeholder for the word of its side. `side` is empty if there is no such word, or more
/// than one.
struct Sided {
  std::optional<Side> side;
  std::string stem;
};

Sided sided(std::string_view name) {
  Sided out;
  for (const std::string& word : words_of(name)) {
    std::optional<Side> side = side_of(word);
    std::string rest;
    // "leftwheel" is one word.
    for (const auto& [prefix, of_prefix] : {std::pair{"left", Side::left}, std::pair{"right", Side::right}}) {
      if (side || !word.starts_with(prefix)) continue;
      side = of_prefix;
      rest = word.substr(std::string_view(prefix).size());
    }
    if (side && out.side) return {};
    if (side) out.side = side;
    out.stem += (side ? "<>" + rest : word) + " ";
  }
  return out;
}

}  // namespace

std::optional<JointPair> recognise_wheels(std::span<const std::string> names) {
  std::map<std::string, std::pair<std::set<std::string>, std::set<std::string>>> by_stem;
  for (const std::string& name : names) {
    const Sided at = sided(name);
    if (at.side == Side::left) by_stem[at.stem].first.insert(name);
    if (at.side == Side::right) by_stem[at.stem].second.insert(name);
  }
  std::vector<JointPair> pairs, wheels;
  for (const auto& [stem, sides] : by_stem) {
    if (sides.first.size() != 1 || sides.second.size() != 1) continue;
    pairs.push_back({*sides.first.begin(), *sides.second.begin()});
    if (speaks_of_wheels(stem)) wheels.push_back(pairs.back());
  }
  if (wheels.size() == 1) return wheels.front();
  if (wheels.empty() && pairs.size() == 1) return pairs.front();
  return std::nullopt;
}

}  // namespace astro::importing
