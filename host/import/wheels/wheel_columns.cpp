#include "host/import/wheels/wheel_columns.hpp"

#include <algorithm>
#include <cctype>
#include <vector>

#include "host/base/text/degrees.hpp"

namespace astro::importing {
namespace {

std::vector<std::string> words_in(std::string_view name) {
  std::vector<std::string> words;
  bool inside = false;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    const bool letter = std::isalnum(byte) != 0;
    if (letter && !inside) words.emplace_back();
    if (letter) words.back() += static_cast<char>(std::tolower(byte));
    inside = letter;
  }
  return words;
}

bool has(const std::vector<std::string>& words, std::initializer_list<std::string_view> any) {
  return std::ranges::any_of(
      words, [&](const std::string& word) { return std::ranges::find(any, word) != any.end(); });
}

struct TravelUnit {
  std::string_view word;
  WheelUnit unit;
  double scale;
};

constexpr TravelUnit kTravelUnits[] = {{"counts", WheelUnit::counts, 1},
                                       {"count", WheelUnit::counts, 1},
                                       {"ticks", WheelUnit::counts, 1},
                                       {"tick", WheelUnit::counts, 1},
                                       {"pulses", WheelUnit::counts, 1},
                                       {"steps", WheelUnit::counts, 1},
                                       {"rad", WheelUnit::radians, 1},
                                       {"radians", WheelUnit::radians, 1},
                                       {"deg", WheelUnit::radians, radians(1)},
                                       {"degrees", WheelUnit::radians, radians(1)},
                                       {"m", WheelUnit::metres, 1},
                                       {"metres", WheelUnit::metres, 1},
                                       {"meters", WheelUnit::metres, 1},
                                       {"cm", WheelUnit::metres, 0.01},
                                       {"mm", WheelUnit::metres, 0.001}};

const TravelUnit* travel_unit(const std::string& word) {
  const auto* found = std::ranges::find(kTravelUnits, word, &TravelUnit::word);
  return found == std::end(kTravelUnits) ? nullptr : found;
}

std::int64_t time_unit_ns(const std::string& word) {
  if (word == "s" || word == "sec" || word == "seconds") return 1'000'000'000;
  if (word == "ms") return 1'000'000;
  if (word == "us") return 1'000;
  return word == "ns" ? 1 : 0;
}

/// The columns found so far; a second column of the same kind makes them unclear.
struct Finder {
  WheelColumns columns;
  std::optional<std::size_t> time, left, right;
  const TravelUnit* unit = nullptr;
  bool unclear = false;

  void take(std::size_t at, const std::vector<std::string>& words) {
    if (words.size() < 2) return;
    const bool to_left = has(words, {"left", "l"}), to_right = has(words, {"right", "r"});
    if (to_left != to_right) return wheel(at, words, to_left ? left : right);
    if (const std::int64_t unit_ns = time_unit_ns(words.back());
        unit_ns > 0 && has(words, {"time", "stamp", "t", "timestamp"}))
      return set(time, at, [&] { columns.time_unit_ns = unit_ns; });
  }

  template <class Found>
  void set(std::optional<std::size_t>& place, std::size_t at, Found found) {
    unclear = unclear || place.has_value();
    place = at;
    found();
  }

  void wheel(std::size_t at, std::vector<std::string> words, std::optional<std::size_t>& place) {
    bool interval = has(words, {"delta"});
    if (words.size() > 2 && words.back() == "interval" && words[words.size() - 2] == "per") {
      interval = true;
      words.resize(words.size() - 2);
    }
    const TravelUnit* found = travel_unit(words.back());
    if (found == nullptr) return;
    const bool same = unit == nullptr || (unit->unit == found->unit && unit->scale == found->scale &&
                                          columns.per_interval == interval);
    unclear = unclear || !same;
    unit = found;
    columns.per_interval = interval;
    set(place, at, [] {});
  }
};

}  // namespace

std::optional<WheelColumns> wheel_columns(std::span<const std::string_view> names) {
  Finder finder;
  for (std::size_t i = 0; i < names.size(); ++i) finder.take(i, words_in(names[i]));
  if (finder.unclear || !finder.time || !finder.left || !finder.right) return std::nullopt;
  WheelColumns columns = finder.columns;
  columns.time = *finder.time;
  columns.left = *finder.left;
  columns.right = *finder.right;
  columns.unit = finder.unit->unit;
  columns.scale = finder.unit->scale;
  return columns;
}

}  // namespace astro::importing
