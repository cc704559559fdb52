#include "host/commands/experiment/tape_dialogue.hpp"

#include <fmt/format.h>

#include "host/base/text/columns.hpp"
#include "host/console/console.hpp"
#include "host/experiment/drive/programme_work.hpp"

namespace astro::commands {
namespace {

using experiment::Redo;

constexpr double kMeasuring_s = 120;  // three readings, and carrying the robot back to its mark

constexpr const char* kDrawing = R"(
        x, ahead                      heading, counter-clockwise is +
           ^
           |    o end                       o front mark on the chassis
           |    :                          /
           |    : x = +                   /   distance of the marks: M
           |    :                        o rear mark
 y, left <-+----'  y = -
           |       (right of the      The front mark is h further left of the
     [=]---+---[=]  line)             line than the rear mark: type h/M, such
       start mark                     as 18/300, or the angle.

Mark the floor under the middle of the axle, and draw a line ahead from there,
where the robot points: each run has to begin exactly so. After a run measure to
the floor under the middle of the axle: x along the line, y across it.
)";

/// "before: 5 + 5 squares and 3 lines"
std::string phase_text(const experiment::Plan& plan, std::size_t phase) {
  const int squares = 2 * plan.runs;
  const auto runs = experiment::runs_of_phase(plan, phase, plan.runs);
  const int lines = static_cast<int>(runs.size()) - squares;
  std::string text =
      fmt::format("{}: {} + {} squares", experiment::phase_names(plan)[phase], plan.runs, plan.runs);
  if (lines > 0) text += fmt::format(" and {} lines", lines);
  return text;
}

/// "back" and "redo", as in the questions for the numbers.
std::optional<Redo> redo_in(const std::string& answer) {
  if (answer == "back") return Redo::enter_again;
  if (answer == "redo") return Redo::drive_again;
  return std::nullopt;
}

}  // namespace

std::string tape_briefing(const experiment::Plan& plan, const std::filesystem::path& folder) {
  const experiment::ProgrammeWork work = work_of(plan, folder);
  const double minutes = (work.driving_s + work.left * kMeasuring_s) / 60;
  std::string phases;
  for (std::size_t i = 0; i < experiment::phase_names(plan).size(); ++i)
    phases += (i == 0 ? "" : "; ") + phase_text(plan, i);
  const std::string text = fmt::format(
      "{} of {} runs are to be driven ({}). Each has three readings: x, y and, if you can, the heading; that "
      "makes {} "
      "readings. It takes about {:.0f} minutes: {:.0f} of driving, and 2 for each run to measure and to "
      "carry the robot back.",
      work.left, work.all, phases, 3 * work.left, minutes, work.driving_s / 60);
  return wrapped(text) + kDrawing;
}

truth::LengthUnit ask_length_unit(const AskLine& ask) {
  const std::string question = "Unit of the lengths you type: mm, cm or m? [mm] ";
  const std::string answer = enter_or(
      ask, question, [](const std::string& word) { return truth::length_unit_named(word).has_value(); });
  return answer.empty() ? truth::LengthUnit::mm : truth::length_unit_named(answer).value();
}

Redo ask_ready(const AskLine& ask, const experiment::RunSpec& next,
               const std::optional<experiment::RunSpec>& last) {
  const std::string prompt =
      fmt::format("next is {}: put the robot on its start mark and press Enter ", next.title());
  if (!last) {
    press_enter(ask, prompt);
    return Redo::no;
  }
  const std::string answer =
      enter_or(ask, fmt::format("('back' corrects {}, 'redo' drives it again)\n{}", last->title(), prompt),
               [](const std::string& word) { return redo_in(word).has_value(); });
  return redo_in(answer).value_or(Redo::no);
}

void ask_put_back(const AskLine& ask, const experiment::RunSpec& run) {
  press_enter(ask,
              fmt::format("{} was broken off: see that the robot is connected, put it back on its\nstart "
                          "mark, and press Enter to drive it again (Ctrl-C ends the experiment) ",
                          run.title()));
}

Redo ask_about(const AskLine& ask, const experiment::DoubtfulRun& run) {
  const std::string prompt =
      wrapped(run.why + '.') + "  yes: it stays as it is; back: enter it again; redo: drive it again: ";
  while (true) {
    const std::string answer = ask(prompt);
    if (answer == "y" || answer == "yes") return Redo::no;
    if (const auto redo = redo_in(answer)) return *redo;
  }
}

}  // namespace astro::commands
