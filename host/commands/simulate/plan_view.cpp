#include "host/commands/simulate/plan_view.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "host/commands/simulate/programme_options.hpp"
#include "host/console/console.hpp"

namespace astro::commands {
namespace {

using calibration::Precision;
using nlohmann::json;
using simulation::study::Forecast;

// The design rules treat arcs as spins, in which the wheels travel far less per turn, so they are too
// optimistic for circles.
std::optional<Precision> design_rules(const Forecast& forecast) {
  if (forecast.programme.counts[simulation::study::kCircles] > 0) return std::nullopt;
  return reachable_precision(forecast.extent, forecast.programme.noise.K_m, forecast.programme.wheelbase_m);
}

std::vector<std::string> percent_row(const std::string& name, const Precision& relative) {
  const auto percent = [](double value) { return fmt::format("{:.4f} %", 100 * value); };
  return {name, percent(relative.E_d), percent(relative.scale), percent(relative.b)};
}

/// What is to be said of e, if it is to be found.
std::string e_text(const Forecast& forecast) {
  if (!forecast.programme.with_e) return {};
  std::string text = fmt::format("standard error of e: {:.4f}\n", forecast.se.e);
  if (const auto why = simulation::study::why_e_is_hidden(forecast.programme.counts))
    text += fmt::format("{}: add {}\n", *why,
                        forecast.programme.counts[simulation::study::kCircles] == 0
                            ? "circles, half of them each way"
                            : "squares or spins");
  return text + '\n';
}

json precision_json(const Precision& relative) {
  return {{"E_d", relative.E_d}, {"S", relative.scale}, {"b", relative.b}};
}

}  // namespace

std::vector<std::string> commands_for(const simulation::study::Programme& programme) {
  return {"astrolabe record " + options_for(programme) + " --truth sim --out programme",
          "astrolabe calibrate runs programme --out calib.toml"};
}

std::string duration_text(double seconds) {
  const auto whole = static_cast<long long>(std::llround(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

std::string plan_text(const Forecast& forecast) {
  std::vector<std::vector<std::string>> rows{
      {"standard errors", "E_d", "S", "b"},
      {"absolute", fmt::format("{:.6f}", forecast.se.E_d), fmt::format("{:.6f}", forecast.se.scale),
       fmt::format("{:.4f} mm", 1000 * forecast.se.b_m)},
      percent_row("relative", forecast.relative())};
  if (const auto rules = design_rules(forecast)) rows.push_back(percent_row("by the design rules", *rules));
  std::string text =
      fmt::format("{}\n{:.0f} m and {:.1f} turns in {} of driving\n\n{}\n{}To drive it and calibrate:\n",
                  forecast.programme.text(), forecast.extent.distance_m,
                  forecast.extent.rotation_rad / (2 * std::numbers::pi),
                  duration_text(forecast.driving_time_s), console::table(rows), e_text(forecast));
  for (const std::string& command : commands_for(forecast.programme)) text += "  " + command + '\n';
  return text;
}

json plan_json(const Forecast& forecast) {
  const simulation::study::Programme& programme = forecast.programme;
  json counts;
  for (std::size_t kind = 0; kind < simulation::study::kKinds; ++kind)
    counts[std::string(simulation::study::kKindNames[kind])] = programme.counts[kind];
  const auto rules = design_rules(forecast);
  json result = {
      {"runs", counts},
      {"side_m", programme.side_m},
      {"line_m", programme.line_m},
      {"turns", programme.turns},
      {"radius_m", programme.radius_m},
      {"K_m", programme.noise.K_m},
      {"wheelbase_m", programme.wheelbase_m},
      {"standard_errors", {{"E_d", forecast.se.E_d}, {"S", forecast.se.scale}, {"b_m", forecast.se.b_m}}},
      {"relative_errors", precision_json(forecast.relative())},
      {"design_rules", rules ? precision_json(*rules) : json()},
      {"driving_time_s", forecast.driving_time_s},
      {"commands", commands_for(programme)},
      {"distance_m", forecast.extent.distance_m},
      {"rotation_rad", forecast.extent.rotation_rad}};
  if (programme.with_e) {
    result["standard_errors"]["e"] = forecast.se.e;
    const auto why = simulation::study::why_e_is_hidden(programme.counts);
    result["e_hidden"] = why ? json(*why) : json();
  }
  return result;
}

}  // namespace astro::commands
