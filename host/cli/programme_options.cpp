#include "host/cli/programme_options.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/cli/options.hpp"
#include "host/cli/study_options.hpp"

namespace astro::cli {
namespace {

void add_rate_of(Command command, const char* name, double& value, const char* type, double greatest,
                 const char* unit, const char* what) {
  command.add_option(name, value, what)
      .type_name(type)
      .check(between(0.01, greatest, unit))
      .capture_default_str();
}

}  // namespace

bool ProgrammeOptions::named() const {
  return std::any_of(counts.begin(), counts.end(), [](const Option& option) { return option.count() > 0; });
}

ProgrammeOptions add_programme(Command command, study::Programme& programme) {
  ProgrammeOptions options;
  const std::array<const char*, study::kKinds> what = {"squares, half of them each way", "straight lines",
                                                       "spins on the spot, half each way",
                                                       "circles of one turn, half each way"};
  for (std::size_t kind = 0; kind < study::kKinds; ++kind)
    options.counts[kind] =
        command.add_option("--" + std::string(study::kKindNames[kind]), programme.counts[kind], what[kind])
            .type_name("N")
            .check(whole(0, study::kMostRuns));
  add_size(command, "--side", programme.side_m, "side of a square, m");
  add_size(command, "--length", programme.line_m, "of a line, m");
  command.add_option("--turns", programme.turns, "of a spin")
      .type_name("N")
      .check(between(0.25, 50, ""))
      .capture_default_str();
  add_size(command, "--radius", programme.radius_m, "of a circle, m");
  add_rate_of(command, "--speed", programme.speed_mps, "V", 10, "m/s", "m/s");
  add_rate_of(command, "--yaw-rate", programme.yaw_rate_radps, "W", 100, "rad/s", "of turns, rad/s");
  return options;
}

std::string options_for(const study::Programme& programme) {
  const study::Programme usual;
  std::string text;
  const auto add = [&](std::string_view name, auto value) {
    text += fmt::format("{}--{} {}", text.empty() ? "" : " ", name, value);
  };
  const auto add_unless_usual = [&](std::string_view name, double value, double otherwise) {
    if (value != otherwise) add(name, value);
  };
  for (std::size_t kind = 0; kind < study::kKinds; ++kind)
    if (programme.counts[kind] > 0) add(study::kKindNames[kind], programme.counts[kind]);
  if (programme.counts[study::kSquares] > 0) add_unless_usual("side", programme.side_m, usual.side_m);
  if (programme.counts[study::kLines] > 0) add_unless_usual("length", programme.line_m, usual.line_m);
  if (programme.counts[study::kSpins] > 0) add_unless_usual("turns", programme.turns, usual.turns);
  if (programme.counts[study::kCircles] > 0) add_unless_usual("radius", programme.radius_m, usual.radius_m);
  add_unless_usual("speed", programme.speed_mps, usual.speed_mps);
  add_unless_usual("yaw-rate", programme.yaw_rate_radps, usual.yaw_rate_radps);
  return text;
}

}  // namespace astro::cli
