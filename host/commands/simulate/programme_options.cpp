#include "host/commands/simulate/programme_options.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/commands/simulate/study_options.hpp"
#include "host/console/options.hpp"

namespace astro::commands {
bool ProgrammeOptions::named() const {
  return std::any_of(counts.begin(), counts.end(),
                     [](const console::Option& option) { return option.count() > 0; });
}

ProgrammeOptions add_programme(console::Command command, simulation::study::Programme& programme) {
  ProgrammeOptions options;
  const std::array<const char*, simulation::study::kKinds> what = {
      "squares, half of them each way", "straight lines", "spins on the spot, half each way",
      "circles of one turn, half each way"};
  for (std::size_t kind = 0; kind < simulation::study::kKinds; ++kind)
    options.counts[kind] = command
                               .add_option("--" + std::string(simulation::study::kKindNames[kind]),
                                           programme.counts[kind], what[kind])
                               .type_name("N")
                               .check(console::whole(0, simulation::study::kMostRuns));
  add_size(command, "--side", programme.side_m, "side of a square, m");
  add_size(command, "--length", programme.line_m, "of a line, m");
  add_ranged(command, "--turns", programme.turns, "of a spin", "N", 0.25, 50, "");
  add_size(command, "--radius", programme.radius_m, "of a circle, m");
  add_ranged(command, "--speed", programme.speed_mps, "m/s", "V", 0.01, 10, "m/s");
  add_ranged(command, "--yaw-rate", programme.yaw_rate_radps, "of turns, rad/s", "W", 0.01, 100, "rad/s");
  return options;
}

std::string options_for(const simulation::study::Programme& programme) {
  const simulation::study::Programme usual;
  std::string text;
  const auto add = [&](std::string_view name, auto value) {
    text += fmt::format("{}--{} {}", text.empty() ? "" : " ", name, value);
  };
  const auto add_unless_usual = [&](std::string_view name, double value, double otherwise) {
    if (value != otherwise) add(name, value);
  };
  for (std::size_t kind = 0; kind < simulation::study::kKinds; ++kind)
    if (programme.counts[kind] > 0) add(simulation::study::kKindNames[kind], programme.counts[kind]);
  if (programme.counts[simulation::study::kSquares] > 0)
    add_unless_usual("side", programme.side_m, usual.side_m);
  if (programme.counts[simulation::study::kLines] > 0)
    add_unless_usual("length", programme.line_m, usual.line_m);
  if (programme.counts[simulation::study::kSpins] > 0)
    add_unless_usual("turns", programme.turns, usual.turns);
  if (programme.counts[simulation::study::kCircles] > 0)
    add_unless_usual("radius", programme.radius_m, usual.radius_m);
  add_unless_usual("speed", programme.speed_mps, usual.speed_mps);
  add_unless_usual("yaw-rate", programme.yaw_rate_radps, usual.yaw_rate_radps);
  return text;
}

}  // namespace astro::commands
