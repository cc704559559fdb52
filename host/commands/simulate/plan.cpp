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
