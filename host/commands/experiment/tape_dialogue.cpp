#include "host/commands/experiment/tape_dialogue.hpp"

#include <fmt/format.h>

#include "host/base/text/columns.hpp"
#include "host/console/console.hpp"

namespace astro::commands {
namespace {

using experiment::Redo;

/// "back" and "redo", as in the questions for the numbers.
std::optional<Redo> redo_in(const std::string& answer) {
  if (answer == "back") return Redo::enter_again;
  if (answer == "redo") return Redo::drive_again;
  return std::nullopt;
}

}  // namespace

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
