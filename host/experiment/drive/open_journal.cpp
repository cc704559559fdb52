#include "host/experiment/drive/open_journal.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "host/base/error.hpp"
#include "host/base/utc.hpp"
#include "host/experiment/analysis/first_drive.hpp"
#include "host/experiment/analysis/squares.hpp"
#include "host/experiment/drive/record_run.hpp"
#include "host/experiment/files/experiment_folder.hpp"
#include "host/experiment/files/robot_identity.hpp"
#include "host/experiment/files/same_number.hpp"
#include "host/recording/end_error.hpp"
#include "host/recording/run_file.hpp"
#include "host/recording/run_metadata.hpp"
#include "host/robot/client/handshake.hpp"

namespace astro::experiment {
namespace {

namespace fs = std::filesystem;

/// `why`: what is wrong with the recording.
Error to_be_driven_again(Remark why, const fs::path& file) {
  why.sentence += to_drive_again(file);
  return Error(why);
}

Error cannot_go_on(const Journal& journal, std::size_t phase, const fs::path& file, const Remark& why) {
  if (!is_over(journal, phase)) return to_be_driven_again(why, file);
  return Error(why.sentence +
                   "; unless a whole copy takes its place, the experiment cannot go on, because the robot "
                   "got other factors since that run",
               ExperimentProblem::cannot_go_on, {file.string()});
}

/// "" if the recording is of this run.
std::string why_other_run(const Journal& journal, const RunSpec& spec, const recording::RunInfo& info) {
  const recording::RunInfo expected = info_of(journal.plan, spec);
  if (info.phase != spec.phase || info.kind != spec.kind || info.direction != spec.direction ||
      info.index != spec.index || !same_number(info.size_m, expected.size_m))
    return "is of another run: " + recording::run_name(info);
  if (const std::string other =
          different_robots("it", identity_of(info), "the experiment", {journal.robot_name, journal.robot_id});
      !other.empty())
    return "is of another robot: " + other;
  const auto loaded = journal.loaded.find(spec.phase);
  if (loaded != journal.loaded.end() && !same_factors(loaded->second, loaded_factors(info)))
    return "was driven with other factors than those with which its phase began";
  return "";
}

/// Nothing if the recording can be used.
std::optional<Remark> why_unusable(const Journal& journal, const RunSpec& spec, const fs::path& file,
                                   const recording::Run& run) {
  const auto unusable = [&](const std::string& fact) {
    return Remark{fact, ExperimentProblem::recording_unusable, {file.string()}};
  };
  if (run.warning)
    return Remark{run.warning->sentence, ExperimentProblem::recording_cut_off, {file.string()}};
  if (const std::string why = why_other_run(journal, spec, run.info); !why.empty())
    return unusable(file.string() + " " + why);
  if (spec.title() == runs_of_phase(journal.plan, 0, 1).front().title())
    if (const auto why = why_wrong_robot(run, "the first drive")) return why;
  if (spec.kind != "square" || (journal.plan.truth == "film" && run.truth.empty())) return std::nullopt;
  try {
    recording::ends_of(run);
  } catch (const Error& error) {
    return unusable(fmt::format("{} cannot be used: {}", file.string(), error.what()));
  }
  return std::nullopt;
}

/// The same of a file, which may be damaged.
std::optional<Remark> why_unusable(const Journal& journal, const RunSpec& spec, const fs::path& file) {
  try {
    return why_unusable(journal, spec, file, recording::read_run(file));
  } catch (const Error& error) {
    return Remark{error.what(), ExperimentProblem::recording_unusable, {file.string()}};
  }
}

void require_recorded(const fs::path& folder, const Journal& journal, std::size_t phase,
                      const RunSpec& spec) {
  const fs::path file = file_of(folder, spec), driven = file_without_truth(folder, spec);
  if (fs::exists(file)) {
    if (const auto why = why_unusable(journal, spec, file)) throw cannot_go_on(journal, phase, file, *why);
  } else if (is_over(journal, phase)) {
    throw cannot_go_on(journal, phase, file, {"'" + file.string() + "' is missing"});
  } else if (fs::exists(driven)) {
    if (const auto warning = recording::read_run(driven).warning)
      throw to_be_driven_again({warning->sentence, ExperimentProblem::recording_cut_off, {driven.string()}},
                               driven);
  }
}

/// The index of the last square of a phase, even if earlier ones are missing.
int last_recorded_square(const fs::path& folder, const Plan& plan, std::size_t phase) {
  if (!open_ended(plan, phase)) return plan.runs;
  int last = squares_in_phase(folder, plan, phase);
  for (int index = last + 1; index <= plan.until->most; ++index)
    for (const RunSpec& spec : squares_of_phase(plan, phase, index))
      if (spec.index == index && fs::exists(file_of(folder, spec))) last = index;
  return last;
}

void require_recorded(const fs::path& folder, const Journal& journal) {
  for (std::size_t phase = 0; phase < phase_names(journal.plan).size(); ++phase) {
    const int squares = last_recorded_square(folder, journal.plan, phase);
    for (const RunSpec& spec : runs_of_phase(journal.plan, phase, squares))
      require_recorded(folder, journal, phase, spec);
  }
}

void require_same(const fs::path& folder, const Journal& journal, const Plan& plan,
                  const RobotIdentity& identity) {
  Plan same = plan;
  // No option sets these, so an experiment that an older version began goes on with its own values.
  same.circles = journal.plan.circles;
  same.circle_turns = journal.plan.circle_turns;
  if (nlohmann::json(journal.plan) != nlohmann::json(same))
    throw Error("'" + folder.string() + "' holds an experiment with other settings",
                ExperimentProblem::other_settings, {folder.string()});
  if (const std::string other = different_robots("the experiment in '" + folder.string() + "'",
                                                 {journal.robot_name, journal.robot_id}, "this", identity);
      !other.empty())
    throw Error(other, ExperimentProblem::other_robot, {folder.string()});
}

}  // namespace

std::string to_drive_again(const fs::path& recording) {
  return " (to drive it again, remove '" + recording.string() + "')";
}

bool is_over(const Journal& journal, std::size_t phase) {
  const std::vector<std::string> names = phase_names(journal.plan);
  return phase + 1 < names.size() && journal.loaded.contains(names[phase + 1]);
}

void require_usable(const fs::path& folder, const Journal& journal, const RunSpec& spec,
                    const recording::Run& run) {
  const fs::path file = file_of(folder, spec);
  if (const auto why = why_unusable(journal, spec, file, run)) throw to_be_driven_again(*why, file);
}

Journal open_journal(const fs::path& folder, const Plan& plan, const robot::Client& client) {
  const protocol::HelloReply& robot = client.robot();
  const RobotIdentity identity = identity_of(robot);
  if (has_journal(folder)) {
    Journal journal = read_journal(folder);
    require_same(folder, journal, plan, identity);
    require_recorded(folder, journal);
    return journal;
  }
  Journal journal;
  journal.plan = plan;
  journal.robot_id = identity.id;
  journal.robot_name = identity.name;
  journal.board = robot.board.view();
  journal.firmware = robot::firmware_version(robot);
  journal.started_at = utc_now();
  write_journal(folder, journal);
  return journal;
}

}  // namespace astro::experiment
