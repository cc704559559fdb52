#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "host/base/error.hpp"
#include "host/base/text/columns.hpp"
#include "host/base/text/degrees.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/base/flags.hpp"
#include "host/commands/experiment/commands.hpp"
#include "host/commands/experiment/film_dialogue.hpp"
#include "host/commands/experiment/tape_dialogue.hpp"
#include "host/commands/experiment/umbmark_options.hpp"
#include "host/commands/experiment/wall_umbmark.hpp"
#include "host/commands/shared/calibration_view.hpp"
#include "host/commands/shared/connection.hpp"
#include "host/commands/shared/film_truth.hpp"
#include "host/commands/shared/gyro_view.hpp"
#include "host/commands/shared/limit_notes.hpp"
#include "host/commands/shared/method_option.hpp"
#include "host/commands/shared/parameter_load.hpp"
#include "host/commands/shared/path_progress.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/commands/shared/truth_option.hpp"
#include "host/console/console.hpp"
#include "host/console/interrupt.hpp"
#include "host/console/options.hpp"
#include "host/console/program.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/experiment/analysis/analysis_problem.hpp"
#include "host/experiment/analysis/judgement_sentences.hpp"
#include "host/experiment/analysis/likelihood_sentences.hpp"
#include "host/experiment/analysis/report_input.hpp"
#include "host/experiment/drive/experiment.hpp"
#include "host/experiment/drive/open_journal.hpp"
#include "host/experiment/files/method_names.hpp"
#include "host/experiment/files/plan.hpp"
#include "host/experiment/files/plan_problem.hpp"
#include "host/report/report.hpp"
#include "host/truth/live/scanner_source.hpp"
#include "host/wall/wall_estimate.hpp"
#include "host/wall/wall_robot.hpp"

namespace astro::commands {
namespace {

/// How much of the present phase has been driven.
struct PhaseProgress {
  int before = 0, total = 1;  // runs
  std::optional<PathProgress> run;

  double fraction() const { return (before + (run ? run->fraction() : 0)) / total; }
};

experiment::ExperimentHooks hooks_for(const UmbmarkOptions& options, console::Progress& progress) {
  experiment::ExperimentHooks hooks;
  const auto way = std::make_shared<PhaseProgress>();
  hooks.run.interrupted = console::interrupted;
  hooks.run.notice = [&progress](const Remark& remark) {
    progress.clear();
    console::say(in_words(remark));
  };
  hooks.run_started = [way, &plan = options.plan, &progress](const experiment::RunSpec& spec, int number,
                                                             int total) {
    *way = {number - 1, total, PathProgress(experiment::path_of(plan, spec))};
    progress.show(way->fraction(), spec.title());
  };
  hooks.run.segment_done = [way](std::uint16_t tag) { way->run->segment_done(tag); };
  hooks.run.moved = [way, &progress](const recording::OdometrySample& sample) {
    way->run->moved_to(sample);
    progress.show(way->fraction(), fmt::format("run {} of {}", way->before + 1, way->total));
  };
  hooks.run_finished = [&progress](const experiment::RunSpec& spec, const recording::Run&) {
    progress.clear();
    console::say("recorded " + spec.title());
  };
  const bool pauses = options.pause || options.truth.source == "manual";
  const AskLine ask = [&progress](const std::string& prompt) {
    progress.clear();
    return console::ask_before_acting(prompt);
  };
  const bool films = options.truth.source == "film" && console::stdin_is_terminal();
  hooks.ready = [pauses, films, ask, phase = std::string()](
                    const experiment::RunSpec& spec, const std::optional<experiment::RunSpec>& last) mutable {
    if (films && std::exchange(phase, spec.phase) != spec.phase) ask_filming(ask, spec.phase);
    return pauses ? ask_ready(ask, spec, last) : experiment::Redo::no;
  };
  hooks.put_back = [ask](const experiment::RunSpec& run) {
    if (!console::stdin_is_terminal()) return false;  // piped answers cannot confirm where the robot is
    ask_put_back(ask, run);
    return true;
  };
  hooks.doubt = [ask](const experiment::DoubtfulRun& run) { return ask_about(ask, run); };
  hooks.give_truth = [&options, &progress](const std::string& phase, experiment::RunSet& set,
                                           const std::vector<std::string>& others) {
    progress.clear();
    take_films(phase, set, {options.film, options.film_figures, others});
  };
  hooks.calibrated = [&progress](const experiment::Calibration& found, const auto& changes) {
    progress.clear();
    console::say('\n' + calibration_summary(found));
    console::say(console::table(experiment::side_by_side(changes)));
    const experiment::FactorErrors& se = found.se_another_day;
    const std::string note =
        experiment::insignificance(changes, {{"c_R", se.c_r}, {"c_L", se.c_l}, {"b", se.b_m}, {"e", se.e}});
    if (!note.empty()) console::say(note);
  };
  hooks.decide = [&options](const experiment::Calibration& found, const auto&) {
    using enum experiment::Decision;
    if (agreed_to_load(found.judgement.verdict, {options.yes, options.force})) return load;
    return experiment::advises_against(found.judgement.verdict) ? keep : later;
  };
  hooks.force = options.force;
  hooks.uploaded = [](const Remark& remark) { console::say(in_words(remark) + "\n"); };
  return hooks;
}

truth::LengthUnit length_unit(const UmbmarkOptions& options) {
  return options.unit.empty() ? ask_length_unit(console::ask)
                              : truth::length_unit_named(options.unit).value();
}

/// Before the first run: what there is to measure, and in which unit.
void brief(UmbmarkOptions& options) {
  console::say(tape_briefing(options.plan, options.out));
  options.truth.units.angle = truth::angle_unit_named(options.angle_unit).value();
  options.truth.units.length = length_unit(options);
}

/// Drives laps in front of a wall in place of squares, with the options that both have.
void run_with_wall(UmbmarkOptions& options) {
  wall::WallPlan& plan = options.wall.plan;
  if (options.wall.alignment.count() > 0) plan.squaring_rad = radians(options.wall.alignment_deg);
  if (options.line.count() > 0) plan.line_m = options.plan.line_m;
  if (options.speed.count() > 0) plan.speed_mps = options.plan.speed_mps;
  if (options.yaw_rate.count() > 0) plan.yaw_rate_radps = options.plan.yaw_rate_radps;
  if (options.until_option.count() > 0) plan.targets = {options.until.target, options.until.target};
  run_wall(options.connection, plan,
           {options.out, truth::length_unit_named(options.unit), options.yes, options.force, options.json});
}

/// By the newest phase from which a calibration was found.
std::optional<experiment::GyroResult> newest_gyro(const experiment::Results& results) {
  const auto phase = std::ranges::find_if(results.phases.rbegin(), results.phases.rend(),
                                          [](const auto& each) { return each.calibration.has_value(); });
  if (phase == results.phases.rend()) return std::nullopt;
  return gyro_of(phase->recordings->set(), *phase->calibration);
}

/// Prints what came out. If the experiment ended before its last phase, its drives advise against loading the factors.
void conclude(const experiment::Results& results, const std::filesystem::path& report, bool as_json) {
  const experiment::Calibration* const not_loaded = results.not_loaded();
  const std::optional<experiment::GyroResult> gyro = newest_gyro(results);
  if (as_json) {
    nlohmann::json json = to_json(results);
    if (gyro) json["gyro"] = experiment::to_json(*gyro);
    json["report"] = report.string();
    print_json(json);
  } else {
    for (const std::string& square : results.left_out()) print(wrapped(square + '.'));
    write(console::table(experiment::before_after_table(results)) + '\n');
    if (results.phases.size() > 1) write(wrapped(results.verdict()));
    if (const experiment::Calibration* const found = results.latest(); found != nullptr && found->absolute())
      write(wrapped(experiment::wheelbase_sentence(*found)));
    if (not_loaded != nullptr)
      write(wrapped(experiment::judgement_sentence(*not_loaded) +
                    " It was not loaded; --force loads it all the same."));
    if (gyro) write(gyro_text(*gyro) + slips_text(gyro->against_wheels, gyro->names));
    print("Report: " + report.string());
  }
  if (not_loaded != nullptr) console::answer_no();
}

void run(UmbmarkOptions& options) {
  options.film = film_named(options.truth.source);
  if (options.film) options.truth.source = "film";
  require_film_for(options.film_figures, options.truth.source == "film");
  refuse_options_of_other_truth(options);
  if (options.truth.source == "wall") return run_with_wall(options);
  options.plan.order = experiment::order_named(options.order);
  options.plan.method = options.method.choice();
  options.plan.extras = !options.no_extras;
  // The port of a scanner may be another one when the experiment is resumed.
  options.plan.truth = truth::scanner_port_in(options.truth.source) ? "lidar" : options.truth.source;
  if (options.until_option.count() > 0) options.plan.until = options.until;
  options.plan.check();
  if (options.truth_folder.count() > 0 && !std::filesystem::is_directory(options.truth.folder))
    throw Error(fmt::format("--truth-folder: there is no folder '{}': make it, or name another",
                            options.truth.folder.string()));
  if (options.truth.folder.empty()) options.truth.folder = options.out / "truth";
  const auto client = connect_to_drive(options.connection);
  robot::Path all;
  for (const experiment::RunSpec& spec : experiment::runs_of_phase(options.plan, 0, 1)) {
    const robot::Path path = experiment::path_of(options.plan, spec);
    all.insert(all.end(), path.begin(), path.end());
  }
  note_limits(*client, all);
  if (options.no_extras && options.truth.source != "manual")
    console::say("squares alone do not show e (whether gentle arcs turn about another wheelbase than spins)");
  if (options.truth.source == "manual") brief(options);
  if (options.truth.source == "film") {
    const double wheelbase_m = robot::RemoteParameters::fetch(*client).number("b");
    const std::string text = film_briefing(options.plan, options.out, wheelbase_m);
    if (!text.empty()) console::say(text);
  }
  console::Progress progress("driving");
  const auto truth = open_truth(options.truth, options.connection.port, [&](const truth::Question& question) {
    progress.clear();
    return ask_person(question);
  });
  const experiment::Results results =
      run_experiment(*client, *truth, options.plan, options.out, hooks_for(options, progress));
  const std::filesystem::path report = std::filesystem::absolute(options.out / "report.html");
  report::write_report(report, experiment::report_input(results));
  conclude(results, report, options.json);
}

constexpr Advice kUmbmarkAdvice[] = {
    {wall::WallProblem::runs_backwards, "; 'astrolabe check-wiring' finds crossed or reversed wires"},
    {experiment::AnalysisProblem::no_squares, ": drive some with 'astrolabe umbmark'"},
    {experiment::AnalysisProblem::no_phase_complete, ": 'astrolabe umbmark --out {0}' goes on from there"},
    {experiment::ExperimentProblem::not_uploaded, ": 'astrolabe umbmark --out {0}' goes on from there"},
    {experiment::ExperimentProblem::other_settings,
     ": give the same ones to go on with it, or another --out"},
    {experiment::ExperimentProblem::other_robot, ": choose another --out"},
    {experiment::ExperimentProblem::cannot_go_on, ": choose another --out"},
    {experiment::ExperimentProblem::other_factors_loaded, ": load those, or choose another --out"},
    {experiment::UploadProblem::e_needed,
     ": update the robot's firmware, or choose a method that takes end poses, such as --method robust"},
    {experiment::ExperimentProblem::precision_unknown, ": give --runs in place of --until"},
    {experiment::ExperimentProblem::truth_missing,
     "; the same command goes on with its ground truth, at a terminal or with all answers piped in"},
    {experiment::ExperimentProblem::broken_off,
     ": put it on its start mark; the same command with --out {0} drives that run again"},
    {experiment::ExperimentProblem::parameters_kept,
     "; 'astrolabe calibrate runs {0}' shows each run, and the same command drives those again whose "
     "recordings are removed there"},
    {experiment::PlanProblem::order_of_open_ended, ": leave out --order"},
    {experiment::PlanProblem::method_without_precision, ": leave out --until or --method {0}"},
    {experiment::PlanProblem::truth_without_precision,
     ": give --runs in place of --until, or another source than --truth {0}"},
    {wall::WallProblem::not_at_wall, "; the same command goes on"},
    {wall::WallProblem::wheels_stand, "; the same command goes on"},
    {wall::WallProblem::turned_away, "; the same command goes on"},
    {wall::WallProblem::no_wall, "; the same command goes on"},
    {wall::SquaringDoubt::Kind::turned,
     "; --alignment says how exactly a front lies against the wall that is not flat"},
    {wall::WallProblem::journal_damaged, ": choose another --out"},
    {wall::WallProblem::other_robot, ": choose another --out"},
    {wall::WallProblem::other_wheel, ": choose another --out"},
    {wall::WallProblem::other_settings, ": give the same ones to go on with it, or another --out"},
};

}  // namespace

void add_umbmark(console::Command app) {
  advise(kUmbmarkAdvice);
  const auto options = std::make_shared<UmbmarkOptions>();
  const console::Command command = app.add_subcommand(
      "umbmark", "the whole experiment: squares, calibration, upload, squares again, report");
  command.alias("experiment");
  add_umbmark_options(command, *options);
  command.footer(
      "Ctrl-C stops the robot; the same command goes on from the last recorded run.\n"
      "--truth file reads a CSV per run: before-square-cw-1.csv, before-line-1.csv, ...\n"
      "Its header names the columns: x_m or x_mm, y_m or y_mm, theta_rad or theta_deg\n"
      "(counter-clockwise). Its first row is the pose at the start, its last row that at\n"
      "the end, in any frame; without theta in the robot's own at the start, x forward:\n"
      "  x_m,y_m,theta_deg\n"
      "  1.000,2.000,90.0\n"
      "  1.012,1.987,91.5\n"
      "Examples:\n"
      "  astrolabe umbmark --truth sim --out my-experiment\n"
      "  astrolabe umbmark --port /dev/ttyACM0 --truth vrpn://lab-pc:3883/ASTRO --out my-experiment\n"
      "  astrolabe umbmark --port /dev/ttyACM0 --truth ros2:/vrpn_mocap/robot/pose --out my-experiment\n"
      "  astrolabe umbmark --port /dev/ttyACM0 --truth manual --runs 5 --side 3 --out my-experiment\n"
      "  astrolabe umbmark --port /dev/ttyACM0 --truth lidar:/dev/ttyUSB0 --out my-experiment\n"
      "  astrolabe umbmark --port /dev/ttyACM0 --truth wall --out my-experiment\n"
      "  astrolabe umbmark --truth sim --until 0.05% --out my-experiment\n"
      "  astrolabe umbmark --port P --truth sim --runs 5 --side 3 --out DIR --yes --json");
  command.callback([options] { run(*options); });
}

}  // namespace astro::commands
