#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "host/base/error.hpp"
#include "host/base/text/columns.hpp"
#include "host/commands/calibrate/commands.hpp"
#include "host/commands/shared/damaged_option.hpp"
#include "host/commands/shared/import_options.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/commands/shared/unused_choices.hpp"
#include "host/console/console.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/experiment/analysis/dead_reckoning.hpp"
#include "host/experiment/analysis/json.hpp"
#include "host/experiment/analysis/likelihood_sentences.hpp"
#include "host/experiment/analysis/scanned_runs.hpp"
#include "host/experiment/analysis/squares.hpp"
#include "host/experiment/files/factors_json.hpp"
#include "host/experiment/files/folder_sessions.hpp"

namespace astro::commands {
namespace {

namespace fs = std::filesystem;
using experiment::DeadReckoning;
using experiment::MlChoice;

struct CheckOptions {
  fs::path folder;  // or files of other programs in `import`
  ImportOptions import;
  std::vector<fs::path> with;
  std::vector<std::string> without;
  std::string clock = "auto";
  bool runs = false, json = false, damaged = false;
};

MlChoice::Clock clock_of(const CheckOptions& options) {
  if (options.clock == "auto") return MlChoice::Clock::automatic;
  return options.clock == "known" ? MlChoice::Clock::known : MlChoice::Clock::estimated;
}

void warn_of_other_robots(const std::vector<experiment::NamedFactors>& factors,
                          const experiment::RunSet& set) {
  const experiment::RobotIdentity driven = experiment::identity_of(set.runs.front().info);
  for (const experiment::NamedFactors& one : factors)
    if (const std::string other =
            experiment::different_robots("'" + one.name + "'", one.robot, "the drives' robot", driven);
        !other.empty())
      console::say("warning: " + other);
}

experiment::RunSet read_drives(const CheckOptions& options) {
  if (options.folder.empty() == !options.import.given())
    throw console::WrongUsage("name either a folder with recordings, or --wheels and --truth of each drive");
  if (options.import.given()) return read_drive_files(options.import);
  refuse_choices_without_drives(options.import);
  experiment::RunSet set = read_recordings(options.damaged, [&](recording::Damage damage) {
    return experiment::read_run_set(options.folder, options.without, damage);
  });
  warn_of_recordings(set.runs);
  if (options.import.session_per_folder) set.sessions = experiment::sessions_by_folder(set, options.folder);
  give_films(set, options.import);
  experiment::give_missing_truth_by_scans(set.runs);
  return set;
}

std::vector<DeadReckoning> evaluated(const CheckOptions& options) {
  const experiment::RunSet set = read_drives(options);
  const auto wheel = experiment::nominal_wheel(set.runs.front().info, set.names.front());
  std::vector<experiment::NamedFactors> factors{{"carried", experiment::loaded_in_all(set)}};
  for (const fs::path& file : options.with) factors.push_back(experiment::factors_of_file(file, wheel));
  warn_of_other_robots(factors, set);
  return experiment::dead_reckon(set, factors, clock_of(options));
}

/// A row for `runs` runs.
std::vector<std::string> row(const std::string& name, std::size_t runs, double final_m, double heading_rad,
                             double path_m) {
  const auto milli = [&](double value) {
    if (!std::isfinite(value)) return std::string("-");
    if (runs < 2) return fmt::format("{:.1f}", 1000 * value);
    return fmt::format("{:.1f} ± {:.1f}", 1000 * value, 1000 * calibration::rms_standard_error(value, runs));
  };
  return {name, milli(final_m), milli(std::abs(heading_rad)), milli(path_m)};
}

/// Leaves out factors with e = 0, which have only one wheelbase.
std::string wheelbases_of(const std::vector<DeadReckoning>& all) {
  std::string text;
  for (const auto& [by, errors] : all)
    if (by.factors.e != 0)
      text += wrapped(
          fmt::format("{}: e = {:.4f}, {}.", by.name, by.factors.e, experiment::wheelbases_text(by.factors)));
  return text;
}

std::string text_of(const std::vector<DeadReckoning>& all, bool runs) {
  std::vector<std::vector<std::string>> rows{{"", "end mm", "heading mrad", "path mm"}};
  for (const DeadReckoning& one : all) {
    const calibration::PathErrors& errors = one.errors;
    rows.push_back(row(one.by.name, errors.runs.size(), errors.final_rms_m, errors.final_heading_rms_rad,
                       errors.path_rms_m));
    if (!runs) continue;
    for (const calibration::RunErrors& run : errors.runs)
      rows.push_back(row("  " + run.name, 1, run.final_m, run.final_heading_rad, run.path_rms_m));
  }
  const std::size_t count = all.front().errors.runs.size();
  return wrapped(fmt::format("Odometry less ground truth over {} drive{}, root mean squares: at the end, and "
                             "all along the path.",
                             count, count == 1 ? "" : "s")) +
         console::table(rows) + wheelbases_of(all);
}

nlohmann::json json_of(const std::vector<DeadReckoning>& all) {
  nlohmann::json json = nlohmann::json::array();
  for (const DeadReckoning& one : all) {
    nlohmann::json runs = nlohmann::json::array();
    for (const calibration::RunErrors& run : one.errors.runs)
      runs.push_back({{"name", run.name},
                      {"end_m", run.final_m},
                      {"heading_rad", experiment::number(run.final_heading_rad)},
                      {"path_m", run.path_rms_m}});
    nlohmann::json entry = experiment::to_json(one.by.factors);
    entry.update({{"by", one.by.name},
                  {"end_m", one.errors.final_rms_m},
                  {"heading_rad", experiment::number(one.errors.final_heading_rms_rad)},
                  {"path_m", one.errors.path_rms_m},
                  {"runs", runs}});
    json.push_back(std::move(entry));
  }
  return json;
}

}  // namespace

void add_calibrate_check(console::Command calibrate) {
  const auto options = std::make_shared<CheckOptions>();
  const console::Command command = calibrate.add_subcommand("check", "test calibrations on recorded drives");
  command.add_option("folder", options->folder, "folder with recordings that have ground truth");
  command.add_option("--with", options->with, "calib.toml to judge (repeatable)").required().one_each_time();
  command.add_option("--without", options->without, "a recording to leave out, by its name (repeatable)")
      .one_each_time();
  command
      .add_option("--clock", options->clock,
                  "known: ground truth has the robot's times;\n"
                  "estimated: offsets and skew are found;\n"
                  "auto: what the recordings say")
      .one_of({"auto", "known", "estimated"})
      .capture_default_str();
  add_damaged_flag(command, options->damaged);
  add_import(command, options->import);
  command.add_flag("--runs", options->runs, "each drive separately, too");
  command.add_flag("--json", options->json, "print one JSON array");
  command.footer(
      "The recorded wheels are followed with the factors that were loaded in the robot\n"
      "and with those of each file. A fair test uses drives that the calibration has\n"
      "not seen.\n"
      "Examples:\n"
      "  astrolabe calibrate check friday --with monday.toml\n"
      "  astrolabe calibrate check friday --with ml.toml --with umbmark.toml --runs\n"
      "  astrolabe calibrate check --wheels ticks.csv --truth take.csv --robot robot.toml --with calib.toml");
  command.callback([options] {
    const std::vector<DeadReckoning> all = evaluated(*options);
    for (const Remark& why : all.front().errors.left_out) console::say("left out: " + in_words(why));
    if (options->json) {
      print_json(json_of(all));
    } else {
      write(text_of(all, options->runs));
    }
  });
}

}  // namespace astro::commands
