#include "host/import/wheels/travel_measure.hpp"

#include <algorithm>
#include <initializer_list>
#include <vector>

#include "host/import/wheels/joint_names.hpp"

namespace astro::importing {
namespace {

constexpr std::string_view kNames[] = {"counts", "rad", "deg", "m", "cm", "mm", "rad/s", "rpm", "m/s"};

bool any_word_of_wheels(std::string_view text) {
  return std::ranges::any_of(words_of(text), [](const std::string& word) { return speaks_of_wheels(word); });
}

class Words {
 public:
  explicit Words(std::string_view text) : words_(words_of(text)) {}

  const std::vector<std::string>& all() const { return words_; }
  bool any(std::initializer_list<std::string_view> of) const {
    return std::ranges::any_of(words_,
                               [&](const std::string& word) { return std::ranges::count(of, word) > 0; });
  }
  bool only(std::initializer_list<std::string_view> of) const {
    return std::ranges::all_of(words_, [&](const std::string& word) {
      return std::ranges::count(of, word) > 0 || word.find_first_not_of("0123456789") == std::string::npos;
    });
  }

 private:
  std::vector<std::string> words_;
};

/// The first word that is one of the units above, of travel or of a speed.
std::optional<TravelMeasure> unit_in(const Words& words, bool per_second) {
  for (const std::string& word : words.all())
    if (const auto unit = tables::unit_named(word); unit && is_travel(unit->quantity) != per_second)
      for (const TravelMeasure& measure : travel_measures())
        if (measure.per_second == per_second && measure.unit == wheel_unit(unit->quantity) &&
            measure.scale == unit->to_si)
          return measure;
  return std::nullopt;
}

std::optional<TravelMeasure> speed_named(const Words& words) {
  if (const auto stated = unit_in(words, true)) return stated;
  if (words.any({"rad", "rads", "radians", "omega", "angular"})) return travel_measure("rad/s");
  if (words.any({"m", "metres", "meters", "linear"})) return travel_measure("m/s");
  return std::nullopt;
}

std::optional<TravelMeasure> length_named(const Words& words) {
  if (const auto stated = unit_in(words, false); stated && stated->unit == WheelUnit::metres) return stated;
  if (words.any({"distance", "dist", "travel", "travelled", "traveled"})) return travel_measure("m");
  return std::nullopt;
}

}  // namespace

WheelUnit wheel_unit(tables::Quantity quantity) {
  switch (quantity) {
    case tables::Quantity::angle:
    case tables::Quantity::angular_speed:
      return WheelUnit::radians;
    case tables::Quantity::length:
    case tables::Quantity::speed:
      return WheelUnit::metres;
    default:
      return WheelUnit::counts;
  }
}

bool is_travel(tables::Quantity quantity) {
  return quantity == tables::Quantity::counts || quantity == tables::Quantity::angle ||
         quantity == tables::Quantity::length;
}

std::span<const TravelMeasure> travel_measures() {
  static const std::vector<TravelMeasure> measures = [] {
    std::vector<TravelMeasure> all;
    for (const std::string_view name : kNames) {
      const tables::Unit unit = tables::unit_named(name).value();
      all.push_back({name, wheel_unit(unit.quantity), unit.to_si, !is_travel(unit.quantity)});
    }
    return all;
  }();
  return measures;
}

std::optional<TravelMeasure> travel_measure(std::string_view name) {
  const auto all = travel_measures();
  const auto found = std::ranges::find(all, name, &TravelMeasure::name);
  return found == all.end() ? std::nullopt : std::optional(*found);
}

NamedMeasure measure_named(std::string_view name, std::string_view context, bool is_integer) {
  const Words words(name);
  if (is_of_no_use(words.all())) return {};
  const bool counts = words.any({"tick", "ticks", "count", "counts", "counter", "encoder", "encoders", "enc",
                                 "pulse", "pulses", "whlenc"});
  const bool about_wheels = counts || any_word_of_wheels(name) || any_word_of_wheels(context);
  if (words.any(
          {"vel", "velocity", "velocities", "speed", "speeds", "rpm", "omega", "mps", "radps", "rate", "hz"}))
    return {about_wheels, speed_named(words)};
  if (counts) return {true, travel_measure("counts")};
  if (words.any({"deg", "degrees"})) return {about_wheels, travel_measure("deg")};
  if (words.any({"position", "pos", "angle", "theta", "rad", "radians"}))
    return {about_wheels, travel_measure(is_integer ? "counts" : "rad")};
  if (const auto length = length_named(words)) return {about_wheels, length};
  const bool bare = words.only({"wheel", "wheels", "motor", "whl", "drive", "data", "value", "feedback",
                                "raw", "state", "front", "rear", "base", "robot", "joint"});
  if (!about_wheels || !bare) return {};
  return {true, is_integer ? travel_measure("counts") : std::nullopt};
}

}  // namespace astro::importing
