#include "host/import/wheels/travel_measure.hpp"

#include <algorithm>
#include <initializer_list>
#include <numbers>
#include <vector>

#include "host/import/wheels/joint_names.hpp"

namespace astro::importing {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180, kRpm_radps = 2 * std::numbers::pi / 60;

constexpr TravelMeasure kMeasures[] = {{"counts", WheelUnit::counts, 1, false},
                                       {"rad", WheelUnit::radians, 1, false},
                                       {"deg", WheelUnit::radians, kDegree_rad, false},
                                       {"m", WheelUnit::metres, 1, false},
                                       {"cm", WheelUnit::metres, 0.01, false},
                                       {"mm", WheelUnit::metres, 0.001, false},
                                       {"rad/s", WheelUnit::radians, 1, true},
                                       {"rpm", WheelUnit::radians, kRpm_radps, true},
                                       {"m/s", WheelUnit::metres, 1, true}};

bool any_word_of_wheels(std::string_view text) {
  return std::ranges::any_of(words_of(text), [](const std::string& word) { return speaks_of_wheels(word); });
}

class Words {
 public:
  explicit Words(std::string_view text) : words_(words_of(text)) {}

  bool any(std::initializer_list<std::string_view> of) const {
    return std::ranges::any_of(words_,
                               [&](const std::string& word) { return std::ranges::count(of, word) > 0; });
  }
  bool all(std::initializer_list<std::string_view> of) const {
    return std::ranges::all_of(words_, [&](const std::string& word) {
      return std::ranges::count(of, word) > 0 || word.find_first_not_of("0123456789") == std::string::npos;
    });
  }

 private:
  std::vector<std::string> words_;
};

std::optional<TravelMeasure> speed_named(const Words& words) {
  if (words.any({"rpm"})) return travel_measure("rpm");
  if (words.any({"rad", "rads", "radps", "radians", "omega", "angular"})) return travel_measure("rad/s");
  if (words.any({"m", "mps", "metres", "meters", "linear"})) return travel_measure("m/s");
  return std::nullopt;
}

std::optional<TravelMeasure> length_named(const Words& words) {
  if (words.any({"mm", "millimetres", "millimeters"})) return travel_measure("mm");
  if (words.any({"cm", "centimetres", "centimeters"})) return travel_measure("cm");
  if (words.any({"m", "metres", "meters", "distance", "dist", "travel", "travelled", "traveled"}))
    return travel_measure("m");
  return std::nullopt;
}

}  // namespace

std::span<const TravelMeasure> travel_measures() { return kMeasures; }

std::optional<TravelMeasure> travel_measure(std::string_view name) {
  const auto found = std::ranges::find(kMeasures, name, &TravelMeasure::name);
  return found == std::end(kMeasures) ? std::nullopt : std::optional(*found);
}

NamedMeasure measure_named(std::string_view name, std::string_view context, bool is_integer) {
  const Words words(name);
  if (words.any({"cmd",       "command",  "commanded", "target", "desired",    "goal",    "ref",
                 "reference", "setpoint", "set",       "error",  "err",        "max",     "min",
                 "limit",     "offset",   "pwm",       "duty",   "gain",       "current", "effort",
                 "torque",    "force",    "status",    "fault",  "temperature"}))
    return {};
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
  const bool bare = words.all({"wheel", "wheels", "motor", "whl", "drive", "data", "value", "feedback", "raw",
                               "state", "front", "rear", "base", "robot", "joint"});
  if (!about_wheels || !bare) return {};
  return {true, is_integer ? travel_measure("counts") : std::nullopt};
}

}  // namespace astro::importing
