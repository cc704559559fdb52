#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "host/base/text/degrees.hpp"
#include "host/base/text/numbers.hpp"
#include "host/commands/base/flags.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/commands/simulate/commands.hpp"
#include "host/commands/simulate/plan_view.hpp"
#include "host/commands/simulate/programme_options.hpp"
#include "host/commands/simulate/study_options.hpp"
#include "host/console/options.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/simulation/study/shortest_programme.hpp"

namespace astro::commands {
namespace {

struct PlanOptions {
  simulation::study::Programme programme;
  ProgrammeOptions runs;
  double sigma_theta_deg = 0.15;
  std::string until;
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
  add_noise(command, programme.noise, options.sigma_theta_deg, programme.truth_rate_hz);
  add_json_flag(command, options.json);
}

void run(PlanOptions& options) {
  simulation::study::Programme& programme = options.programme;
  const bool named = options.runs.named();
  if (!options.until.empty() && named)
    throw console::WrongUsage(
        "--until finds the numbers of runs: give either it or --squares, --lines, --spins, --circles");
  if (options.until.empty() && !options.kinds.empty())
    throw console::WrongUsage("--kinds says what --until may use: give both, or numbers of runs instead");
  programme.noise.sigma_theta_rad = radians(options.sigma_theta_deg);
  simulation::study::Forecast forecast;
  if (options.until.empty()) {
    if (!named) programme.counts[simulation::study::kSquares] = 10;
    forecast = simulation::study::forecast(programme);
  } else {
    const double target = *precision_named(options.until);
    forecast = shortest_programme({target, target, target}, kinds_named(options.kinds), programme);
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
      "Without runs it is about 10 squares. Standard errors are the Cramer-Rao bound of 'calibrate runs "
      "--method ml' with the given slip and\n"
      "ground truth; the time is that of driving alone. Tyres may turn about another point in spins\n"
      "than in arcs: a wheelbase for both needs runs of both.\n"
      "Examples:\n"
      "  astrolabe plan --squares 10 --side 3\n"
      "  astrolabe plan --lines 8 --length 5 --spins 2 --turns 5 --wheelbase 0.2\n"
      "  astrolabe plan --until 0.05%\n"
      "  astrolabe plan --until 0.05% --kinds squares,lines --side 2");
  command.callback([options] { run(*options); });
}

}  // namespace astro::commands
