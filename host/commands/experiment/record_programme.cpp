#include "host/commands/experiment/record_programme.hpp"

#include <fmt/format.h>

#include <optional>

#include "host/base/error.hpp"
#include "host/base/folder_lock.hpp"
#include "host/base/text/sense.hpp"
#include "host/base/utc.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/experiment/tape_dialogue.hpp"
#include "host/commands/shared/limit_notes.hpp"
#include "host/commands/shared/path_progress.hpp"
#include "host/console/console.hpp"
#include "host/console/interrupt.hpp"
#include "host/recording/run_file.hpp"

namespace astro::commands {
namespace {

namespace fs = std::filesystem;
using simulation::study::Programme;

robot::Path path_of(const Programme& programme, std::size_t kind, Sense sense) {
  const robot::PathLimits limits{programme.speed_mps, programme.yaw_rate_radps};
  switch (kind) {
    case simulation::study::kSquares:
      return robot::square(programme.side_m, sense, limits);
    case simulation::study::kLines:
      return robot::line(programme.line_m, limits);
    case simulation::study::kSpins:
      return robot::spin(sense == Sense::cw ? -programme.turns : programme.turns, limits);
    default:
      return robot::circle(programme.radius_m, 1, sense, limits);
  }
}

double size_of(const Programme& programme, std::size_t kind) {
  switch (kind) {
    case simulation::study::kSquares:
      return programme.side_m;
    case simulation::study::kLines:
      return programme.line_m;
    case simulation::study::kCircles:
      return programme.radius_m;
    default:
      return 0;
  }
}

ProgrammeRun run_of(const Programme& programme, std::size_t kind, int number) {
  std::string name(simulation::study::kKindNames[kind]);
  name.pop_back();
  const bool turns = kind != simulation::study::kLines;
  const Sense sense = number % 2 == 0 ? Sense::cw : Sense::ccw;
  return {{"", name, turns ? std::optional(sense) : std::nullopt, turns ? number / 2 + 1 : number + 1},
          size_of(programme, kind),
          path_of(programme, kind, sense)};
}

std::vector<ProgrammeRun> missing_of(const std::vector<ProgrammeRun>& runs, const fs::path& folder) {
  std::vector<ProgrammeRun> missing;
  for (const ProgrammeRun& run : runs)
    if (!fs::exists(folder / run.spec.file_name())) missing.push_back(run);
  if (missing.empty())
    throw Error(fmt::format(
        "'{}' holds all of these runs already, and a recording replaces nothing: name another folder",
        folder.string()));
  if (missing.size() < runs.size())
    console::say(
        fmt::format("{} of {} runs are recorded already", runs.size() - missing.size(), runs.size()));
  return missing;
}

}  // namespace

std::vector<ProgrammeRun> runs_of(const Programme& programme) {
  std::vector<ProgrammeRun> runs;
  for (std::size_t kind = 0; kind < simulation::study::kKinds; ++kind)
    for (int number = 0; number < programme.counts[kind]; ++number)
      runs.push_back(run_of(programme, kind, number));
  return runs;
}

void record_programme(robot::Client& client, truth::Source& truth, const std::vector<ProgrammeRun>& runs,
                      const recording::RunInfo& info, const fs::path& folder, bool pause) {
  const FolderLock lock(folder);
  console::Progress progress("driving");
  experiment::RunHooks hooks;
  hooks.interrupted = console::interrupted;
  hooks.notice = [&](const Remark& remark) {
    progress.clear();
    console::say(in_words(remark));
  };
  double before = 0;
  const std::vector<ProgrammeRun> missing = missing_of(runs, folder);
  std::optional<PathProgress> way;  // of the run under way
  hooks.segment_done = [&](std::uint16_t tag) { way->segment_done(tag); };
  hooks.moved = [&](const recording::OdometrySample& sample) {
    way->moved_to(sample);
    progress.show((before + way->fraction()) / static_cast<double>(missing.size()),
                  fmt::format("run {:.0f} of {}", before + 1, missing.size()));
  };
  robot::Path all;
  for (const ProgrammeRun& run : missing) all.insert(all.end(), run.path.begin(), run.path.end());
  note_limits(client, all);
  for (const ProgrammeRun& run : missing) {
    if (pause) ask_ready(console::ask_before_acting, run.spec, std::nullopt);
    way.emplace(run.path);
    recording::RunInfo about = info;
    about.kind = run.spec.kind;
    about.direction = run.spec.direction;
    about.index = run.spec.index;
    about.size_m = run.size_m;
    about.started_at = utc_now();
    recording::write_run(folder / run.spec.file_name(), record_run(client, truth, run.path, about, hooks));
    progress.clear();
    console::say("recorded " + run.spec.title());
    ++before;
  }
}

}  // namespace astro::commands
