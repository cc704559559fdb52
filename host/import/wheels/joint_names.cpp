#include "host/import/wheels/joint_names.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace astro::importing {
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

namespace {

std::optional<Side> side_of(const std::string& word) {
  static const std::map<std::string, Side> sides = {
      {"left", Side::left},   {"l", Side::left},  {"lhs", Side::left},  {"port", Side::left},
      {"right", Side::right}, {"r", Side::right}, {"rhs", Side::right}, {"starboard", Side::right}};
  const auto found = sides.find(word);
  return found == sides.end() ? std::nullopt : std::optional(found->second);
}

/// "leftwheel" and "lwheel" are one word each. Nothing if the word does not begin with a side.
std::optional<std::pair<Side, std::string>> side_and_rest(const std::string& word) {
  for (const auto& [prefix, side] : {std::pair{"left", Side::left}, std::pair{"right", Side::right}})
    if (word.starts_with(prefix)) return std::pair{side, word.substr(std::string_view(prefix).size())};
  for (const char* part : {"wheel", "whl", "enc", "motor", "tick"})
    for (const auto& [letter, side] : {std::pair{'l', Side::left}, std::pair{'r', Side::right}})
      if (word.starts_with(letter + std::string(part))) return std::pair{side, word.substr(1)};
  return std::nullopt;
}

}  // namespace

bool speaks_of_wheels(std::string_view words) {
  for (const char* word : {"wheel", "tyre", "tire", "drive", "motor"})
    if (words.find(word) != std::string_view::npos) return true;
  return false;
}

SidedName sided_name(std::string_view name) {
  SidedName out;
  for (const std::string& word : words_of(name)) {
    std::optional<Side> side = side_of(word);
    std::string rest;
    if (!side)
      if (auto parts = side_and_rest(word)) std::tie(side, rest) = std::move(*parts);
    if (side && out.side) return {};
    if (side) out.side = side;
    out.stem += (side ? "<>" + rest : word) + " ";
  }
  return out;
}

std::optional<JointPair> recognise_wheels(std::span<const std::string> names) {
  std::map<std::string, std::pair<std::set<std::string>, std::set<std::string>>> by_stem;
  for (const std::string& name : names) {
    const SidedName at = sided_name(name);
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
