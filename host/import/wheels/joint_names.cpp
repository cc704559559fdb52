#include "host/import/wheels/joint_names.hpp"

#include <algorithm>
#include <cctype>
#include <functional>
#include <map>
#include <optional>
#include <set>
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

std::optional<SidedWord> sided_word(const std::string& word) {
  static const std::set<std::string_view> kLeft{"lhs",       "port",     "links",   "linke",
                                                "linkes",    "linker",   "gauche",  "izquierda",
                                                "izquierdo", "sinistra", "sinistro"};
  static const std::set<std::string_view> kRight{"rhs",     "starboard", "rechts", "rechte",
                                                 "rechtes", "rechter",   "droite", "droit",
                                                 "derecha", "derecho",   "destra", "destro"};
  if (kLeft.contains(word)) return SidedWord{Side::left, ""};
  if (kRight.contains(word)) return SidedWord{Side::right, ""};
  const std::size_t left = word.find("left"), right = word.find("right");
  if ((left == word.npos) != (right == word.npos))
    return left != word.npos ? SidedWord{Side::left, word.substr(0, left) + word.substr(left + 4)}
                             : SidedWord{Side::right, word.substr(0, right) + word.substr(right + 5)};
  for (const std::string_view front :
       {"",      "w",     "v",     "m",      "e",   "d",     "q",     "enc", "encoder",
        "tick",  "ticks", "count", "counts", "pos", "wheel", "motor", "phi", "th",
        "theta", "omega", "f",     "r",      "b",   "front", "rear",  "back"}) {
    if (word == std::string(front) + "l") return SidedWord{Side::left, std::string(front), true};
    if (word == std::string(front) + "r") return SidedWord{Side::right, std::string(front), true};
  }
  for (const std::string_view end : {"wheel", "wheels", "whl", "enc", "encoder", "tick", "ticks", "motor",
                                     "w", "f", "r", "b", "front", "rear"}) {
    if (word == "l" + std::string(end)) return SidedWord{Side::left, std::string(end), true};
    if (word == "r" + std::string(end)) return SidedWord{Side::right, std::string(end), true};
  }
  return std::nullopt;
}

std::vector<std::optional<SidedWord>> sided_words(std::span<const std::string> words) {
  std::vector<std::optional<SidedWord>> sided;
  for (const std::string& word : words) sided.push_back(sided_word(word));
  if (std::ranges::any_of(sided, [](const auto& one) { return one && !one->is_letter; }))
    for (auto& one : sided)
      if (one && one->is_letter) one.reset();
  return sided;
}

bool is_of_no_use(std::span<const std::string> words) {
  static const std::set<std::string, std::less<>> kUseless = {
      "cmd",         "command",   "commanded", "target", "setpoint", "set",     "desired", "goal",    "ref",
      "reference",   "requested", "pwm",       "duty",   "gain",     "current", "amps",    "voltage", "volt",
      "volts",       "torque",    "force",     "effort", "error",    "err",     "acc",     "accel",   "temp",
      "temperature", "power",     "max",       "min",    "limit",    "offset",  "status",  "fault"};
  return std::ranges::any_of(words, [](const std::string& word) { return kUseless.contains(word); });
}

bool speaks_of_wheels(std::string_view words) {
  for (const char* word : {"wheel", "tyre", "tire", "drive", "motor"})
    if (words.find(word) != std::string_view::npos) return true;
  return false;
}

SidedName sided_name(std::string_view name) {
  SidedName out;
  const std::vector<std::string> words = words_of(name);
  const std::vector<std::optional<SidedWord>> all = sided_words(words);
  for (std::size_t i = 0; i < words.size(); ++i) {
    std::optional<SidedWord> sided = all[i];
    // Which axle of "fl" and "rl" is driven, the names of joints do not show.
    if (sided && (sided->rest == "f" || sided->rest == "r" || sided->rest == "b")) sided.reset();
    if (sided && out.side) return {};
    if (sided) out.side = sided->side;
    out.stem += (sided ? "<>" + sided->rest : words[i]) + " ";
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
