#include "host/commands/experiment/film_dialogue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "host/base/error.hpp"
#include "host/base/interrupted.hpp"
#include "host/base/text/columns.hpp"
#include "host/base/text/trimmed.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/shared/film_truth.hpp"
#include "host/console/console.hpp"
#include "host/experiment/drive/programme_work.hpp"

namespace astro::commands {
namespace {

namespace fs = std::filesystem;

/// Paths between commas, perhaps in quotes as a file manager pastes them.
std::vector<fs::path> paths_in(const std::string& answer) {
  std::vector<fs::path> paths;
  for (std::size_t from = 0; from <= answer.size();) {
    const std::size_t comma = std::min(answer.find(',', from), answer.size());
    std::string word(trimmed(answer.substr(from, comma - from)));
    if (word.size() > 1 && (word.front() == '\'' || word.front() == '"') && word.back() == word.front())
      word = word.substr(1, word.size() - 2);
    if (!word.empty()) paths.emplace_back(word);
    from = comma + 1;
  }
  return paths;
}

/// Refuses the film of another phase: it would fit, because the robot drives the same in each phase.
void refuse_other(const film::NamedFilm& film, const FilmRequest& request) {
  if (std::find(request.others.begin(), request.others.end(), film.track.fingerprint) != request.others.end())
    throw Error("'" + film.name +
                "' shows the runs of an earlier phase: name the film that shows these runs");
}

/// False, after saying why, if the films do not show the runs.
bool taken(const std::vector<fs::path>& paths, experiment::RunSet& set, const FilmRequest& request) {
  try {
    experiment::RunSet with = set;
    const std::vector<film::NamedFilm> films = follow_films(paths, request.figures);
    for (const film::NamedFilm& film : films) refuse_other(film, request);
    give_truth(with, films, request.figures);
    set = std::move(with);
    return true;
  } catch (const Interrupted&) {
    throw;
  } catch (const Error& error) {
    console::say(wrapped(in_words(error) + '.'));
    return false;
  }
}

}  // namespace

std::string film_briefing(const experiment::Plan& plan, const fs::path& folder, double wheelbase_m) {
  const experiment::ProgrammeWork work = work_of(plan, folder);
  if (work.left == 0) return "";
  bool open_ended = false;
  for (std::size_t phase = 0; phase < experiment::phase_names(plan).size(); ++phase)
    open_ended = open_ended || experiment::open_ended(plan, phase);
  const experiment::DrivenField field = field_of(plan, wheelbase_m);
  return wrapped(
             "The phone films the tag on the robot all the time: put it on a shelf or a tripod 2 m high or "
             "higher, looking down by 35 degrees or more, so that the whole field and all tags on the floor "
             "are in the picture. 1080p, stabilisation off, focus and exposure locked. Begin to film before "
             "the first run, and do not touch the phone until all runs of the phase are driven; then stop "
             "filming, copy the file to this computer, and name it when asked.") +
         "'astrolabe truth film FILE' looks at a film alone.\n" +
         wrapped(fmt::format(
             "{}{} of {} runs are to be driven, for about {:.0f} minutes. From its start mark the middle of "
             "the robot may drive {:.1f} m ahead and {:.1f} m back, {:.1f} m to the left and {:.1f} m to the "
             "right, because squares of a robot that nobody has calibrated turn about their start; it needs "
             "half a metre more on each side.",
             open_ended ? "At least " : "", work.left, work.all, std::ceil(work.driving_s / 60),
             field.to_ahead_m, std::abs(field.from_ahead_m), field.to_left_m, std::abs(field.from_left_m)));
}

void ask_filming(const AskLine& ask, const std::string& phase) {
  press_enter(ask, fmt::format("Begin to film phase '{}', step aside and press Enter ", phase));
}

void take_films(const std::string& phase, experiment::RunSet& set, const FilmRequest& request) {
  if (request.file && fs::exists(*request.file) && taken({*request.file}, set, request)) return;
  while (true) {
    std::string answer;
    try {
      answer = console::ask(
          fmt::format("the film of the {} run{} of phase '{}' that have none (several: separated by commas; "
                      "Enter: later): ",
                      set.runs.size(), set.runs.size() == 1 ? "" : "s", phase));
    } catch (const Interrupted&) {
      throw;
    } catch (const Error&) {
      answer.clear();  // nobody can be asked
    }
    const std::vector<fs::path> paths = paths_in(answer);
    if (paths.empty())
      throw Error(
          fmt::format("all runs of phase '{}' are driven, but their film is missing: the same command with "
                      "--truth film:FILE goes on with it",
                      phase));
    if (taken(paths, set, request)) return;
  }
}

}  // namespace astro::commands
