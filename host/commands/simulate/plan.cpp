#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "host/base/text/degrees.hpp"
#include "host/base/text/numbers.hpp"
#include "host/commands/base/flags.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/commands/simulate/commands.hpp"
#include "host/commands/simulate/programme_options.hpp"
#include "host/commands/simulate/study_options.hpp"
#include "host/console/console.hpp"
#include "host/console/options.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/simulation/study/programme.hpp"
#include "host/simulation/study/shortest_programme.hpp"

namespace astro::commands {
namespace {

using calibration::Precision;
using nlohmann::json;
using simulation::study::Forecast;

struct PlanOptions {
  simulation::study::Programme programme;
  ProgrammeOptions runs;
  double sigma_theta_deg = 0.15;
  std::string until, until_e;
  std::vector<std::string> kinds;
  bool json = false;
};

// "0.05%" or "0.0005"; values below 1e-9 or above 0.1 are probably typing errors.
std::optional<double> precision_named(std::string text) {
  const bool percent = text.ends_with('%');
  if (percent) text.pop_back();
  const auto number = number_in(text);
  if (!number) return std::nullopt;
  const double value = percent ? *number / 100 : *number;
  return value >= 1e-9 && value <= 0.1 ? std::optional(value) : std::nullopt;
}

std::vector<simulation::study::Kind> kinds_named(const std::vector<std::string>& names) {
  std::vector<simulation::study::Kind> kinds;
  for (std::size_t kind = 0; kind < simulation::study::kKinds; ++kind)
    if (names.empty() ||
        std::find(names.begin(), names.end(), simulation::study::kKindNames[kind]) != names.end())
      kinds.push_back(static_cast<simulation::study::Kind>(kind));
  return kinds;
}

void add_target(console::Command command, PlanOptions& options) {
  command
      .add_option("--until", options.until,
                  "find the shortest programme whose standard errors of E_d, S and b\n"
                  "are all at most this: 0.05% or 0.0005")
      .type_name("PRECISION")
      .check([](const std::string& text) {
        return precision_named(text) ? ""
                                     : "'" + text + "' is no precision: give 0.05% or 0.0005, at most 10%";
      });
  command
      .add_option("--until-e", options.until_e,
                  "with --until: find e as well, with at most this standard error: 0.002")
      .type_name("PRECISION")
      .check([](const std::string& text) {
        return precision_named(text) ? "" : "'" + text + "' is no precision: give 0.2% or 0.002, at most 10%";
      });
  command.add_option("--kinds", options.kinds, "with --until: use only these of squares,lines,spins,circles")
      .type_name("KIND,...")
      .delimiter(',')
      .check([](const std::string& name) {
        return kinds_named({name}).empty() ? "'" + name + "' is none of squares,lines,spins,circles" : "";
      });
}

void add_robot(console::Command command, PlanOptions& options) {
  simulation::study::Programme& programme = options.programme;
  add_size(command, "--wheelbase", programme.wheelbase_m, "of the robot, m");
  command.add_flag("--with-e,--e", programme.with_e,
                   "of a robot whose e is to be found as well: gentle arcs turn about\n"
                   "the wheelbase times 1 + e, spins about it");
  add_noise(command, programme.noise, options.sigma_theta_deg, programme.truth_rate_hz);
  add_json_flag(command, options.json);
}

void require_meaning(const PlanOptions& options) {
  const bool until = !options.until.empty(), until_e = !options.until_e.empty();
  if (until && options.runs.named())
    throw console::WrongUsage(
        "--until finds the numbers of runs: give either it or --squares, --lines, --spins, --circles");
  if (!until && !options.kinds.empty())
    throw console::WrongUsage("--kinds says what --until may use: give both, or numbers of runs instead");
  if (!until && until_e)
    throw console::WrongUsage("--until-e adds e to what --until finds a programme for: give both");
  if (until && options.programme.with_e && !until_e)
    throw console::WrongUsage("--until needs a precision for e as well: give it as --until-e");
}

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

/// The forecast for e, if e is to be estimated.
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

/// The commands that drive the programme and calibrate from it.
std::vector<std::string> commands_for(const simulation::study::Programme& programme) {
  return {"astrolabe record " + options_for(programme) + " --truth sim --out programme",
          "astrolabe calibrate runs programme --out calib.toml"};
}

/// "8 min 47 s", "2 h 03 min".
std::string duration_text(double seconds) {
  const auto whole = static_cast<long long>(std::llround(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

/// At most 80 columns, unless all four kinds have hundreds of runs.
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

void run(PlanOptions& options) {
  simulation::study::Programme& programme = options.programme;
  require_meaning(options);
  programme.noise.sigma_theta_rad = radians(options.sigma_theta_deg);
  simulation::study::Forecast forecast;
  if (options.until.empty()) {
    if (!options.runs.named()) {
      programme.counts[simulation::study::kSquares] = programme.with_e ? 6 : 10;
      programme.counts[simulation::study::kCircles] = programme.with_e ? 6 : 0;
    }
    forecast = simulation::study::forecast(programme);
  } else {
    const double target = *precision_named(options.until);
    forecast = shortest_programme({target, target, target}, kinds_named(options.kinds), programme,
                                  precision_named(options.until_e));
  }
  options.json ? print_json(plan_json(forecast)) : write(plan_text(forecast));
}

}  // namespace

void add_plan(console::Command app) {
  const auto options = std::make_shared<PlanOptions>();
  const console::Command command = app.add_subcommand(
      "plan", "before driving: the precision of a programme, or the programme for a precision");
  options->runs = add_programme(command, options->programme);
  add_target(command, *options);
  add_robot(command, *options);
  command.footer(
      "Without runs it is about 10 squares, with --e about 6 squares and 6 circles.\n"
      "Standard errors are the Cramer-Rao bound of 'calibrate runs --method ml' with\n"
      "the given slip and ground truth; the time is that of driving alone.\n"
      "Tyres may turn about another point in spins than in arcs: a wheelbase for both\n"
      "needs runs of both.\n"
      "Examples:\n"
      "  astrolabe plan --squares 10 --side 3\n"
      "  astrolabe plan --lines 8 --length 5 --spins 2 --turns 5 --wheelbase 0.2\n"
      "  astrolabe plan --e --squares 6 --circles 6 --radius 0.75\n"
      "  astrolabe plan --until 0.05%\n"
      "  astrolabe plan --until 0.05% --until-e 0.2%\n"
      "  astrolabe plan --until 0.05% --kinds squares,lines --side 2");
  command.callback([options] { run(*options); });
}

}  // namespace astro::commands
