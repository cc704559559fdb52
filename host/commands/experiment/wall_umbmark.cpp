#include "host/commands/experiment/wall_umbmark.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/base/interrupted.hpp"
#include "host/base/text/columns.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/experiment/tape_dialogue.hpp"
#include "host/commands/experiment/wall_dialogue.hpp"
#include "host/commands/shared/parameter_load.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/console/console.hpp"
#include "host/console/interrupt.hpp"
#include "host/console/program.hpp"
#include "host/experiment/analysis/judgement_sentences.hpp"
#include "host/wall/wall_calibration.hpp"
#include "host/wall/wall_experiment.hpp"
#include "host/wall/wall_judgement.hpp"
#include "host/wall/wall_programme.hpp"

namespace astro::commands {
namespace {

using wall::WallHooks;
using wall::WallResult;

WallHooks hooks_for(truth::LengthUnit unit, console::Progress& progress) {
  const AskLine ask = [&progress](const std::string& prompt) {
    progress.clear();
    return console::ask_before_acting(prompt);
  };
  WallHooks hooks;
  hooks.drive.interrupted = console::interrupted;
  hooks.drive.notice = [&progress](const Remark& remark) {
    progress.clear();
    console::say(in_words(remark));
  };
  hooks.placed = [ask] { ask_facing_wall(ask); };
  hooks.read_gap = [ask, unit](double expected_m) { return ask_gap(ask, expected_m, unit); };
  hooks.read_again = [ask, unit](const wall::GapDoubt& doubt) { return ask_gap_again(ask, doubt, unit); };
  hooks.move_started = [&progress](const wall::WallMove& move, int number, int total) {
    progress.show(static_cast<double>(number - 1) / total,
                  fmt::format("{} of about {}: {}", number, total, title_of(move)));
  };
  return hooks;
}

/// False if the factors are not loaded because the drives advise against it, which is a result and no error.
bool load(robot::Client& client, const experiment::ParameterFile& file, const std::filesystem::path& path,
          const WallSettings& settings) {
  const bool nobody_to_ask = settings.yes || !console::stdin_is_terminal();
  if (experiment::advises_against(file.verdict) && nobody_to_ask && !settings.force) return false;
  const LoadResult loaded =
      load_parameters(client, robot::RemoteParameters::fetch(client), file, {settings.yes, settings.force});
  if (loaded.advised_against) return false;
  if (loaded.declined)
    throw Error("nothing was changed; 'astrolabe upload " + path.string() + "' loads it later");
  if (loaded.report && loaded.report->active != robot::ActiveSet::new_set)
    throw Error(loaded.report->remark());
  if (loaded.report) console::say(in_words(loaded.report->remark()));
  return true;
}

/// Says what the robot will do, and returns how many gaps somebody has to read.
int brief(const wall::WallPlan& plan, robot::Client& client, const WallSettings& settings) {
  const wall::WallRobot robot = wall::wall_robot_of(robot::RemoteParameters::fetch(client));
  const auto journal = wall::read_wall_journal(settings.out);
  int readings = plan.readings;
  if (journal) {
    const auto next = wall::next_move(
        *journal, wall::estimate_wall(journal->drive, journal->loaded, plan.usual_noise()), robot);
    if (!next) return 0;
    const bool one_more =
        next->kind == wall::WallMove::Kind::gap;  // those that were read contradict each other
    readings = std::max(wall::gaps_left(*journal), one_more ? 1 : 0);
  }
  const auto course = wall::plan_course(wall::wishes_of(plan, robot), robot.loaded);
  console::say(wall_briefing(plan, course, readings, journal ? journal->driven_s : 0));
  return readings;
}

WallResult drive(robot::Client& client, const wall::WallPlan& plan, const WallSettings& settings,
                 const WallHooks& hooks) {
  try {
    return wall::run_wall_experiment(client, plan, settings.out, hooks);
  } catch (const Interrupted&) {
    throw Interrupted("interrupted; the same command goes on with what was driven");
  }
}

}  // namespace

void add_wall_options(console::Command command, WallOptions& options) {
  wall::WallPlan& plan = options.plan;
  const auto add = [&](const std::string& name, auto& value, const std::string& what) {
    options.own.emplace_back(name,
                             command.add_option(name, value, "--truth wall: " + what).capture_default_str());
  };
  add("--readings", plan.readings, "how often somebody reads the ruler;\n0: the scale stays as it is");
  add("--gap", plan.gap_m, "the gap that the ruler shows, m");
  add("--minutes", plan.most_minutes, "the most of driving");
  options.alignment = command.add_option(
      "--alignment", options.alignment_deg,
      "--truth wall: how exactly the front lies against the\nwall each time, degrees; a flat one to 0.1");
  options.own.emplace_back("--alignment", options.alignment);
  add("--push", plan.push.force_N, "the hardest push against the wall, N");
  add("--stall-torque", plan.push.stall_Nm, "of a motor at its wheel, N m");
  add("--stall-voltage", plan.push.stall_V, "at which it has that torque, V");
  add("--front-to-axle", plan.body.front_to_axle_m, "from the front to the axle, m");
  add("--robot-length", plan.body.length_m, "m");
  add("--robot-width", plan.body.width_m, "m");
}

void run_wall(ConnectionOptions& connection, const wall::WallPlan& plan, const WallSettings& settings) {
  plan.check();
  const auto client = connect_to_drive(connection);
  const int readings = brief(plan, *client, settings);
  const truth::LengthUnit unit = settings.unit  ? *settings.unit
                                 : readings > 0 ? ask_length_unit(console::ask)
                                                : truth::LengthUnit::mm;
  console::Progress progress("driving");
  const WallResult result = drive(*client, plan, settings, hooks_for(unit, progress));
  progress.clear();
  const auto judgement = wall::judge_wall(result.journal.drive, result.estimate, result.journal.loaded);
  const experiment::ParameterFile file = wall::parameter_file_of(result, judgement);
  const std::filesystem::path path = std::filesystem::absolute(settings.out / "calib.toml");
  experiment::write_parameter_file(path, file);
  if (settings.json) {
    nlohmann::json json = to_json(result, judgement);
    json["calibration"] = path.string();
    print_json(json);
  } else {
    write(wall_result_text(result) + wrapped(judgement.sentence()));
    print("Calibration: " + path.string());
  }
  if (load(*client, file, path, settings)) return;
  console::say(wrapped("It was not loaded; --force loads it all the same."));
  console::answer_no();
}

}  // namespace astro::commands
