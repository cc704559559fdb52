#include "host/commands/shared/option_words.hpp"

#include <fmt/format.h>

#include "host/import/drives/stated_drives.hpp"

namespace astro::commands {

std::string in_words_of_options(const Error& error) {
  using enum importing::StatementProblem;
  if (error.kind() == joints_not_paired)
    return "--joints takes two names, LEFT,RIGHT, or as many for each side: LEFT+LEFT,RIGHT+RIGHT";
  if (error.kind() == frames_not_two) return "--truth-frames takes two names, PARENT,CHILD";
  if (error.kind() == not_paired)
    return fmt::format("there are {} --wheels and {} --truth: each drive needs both", error.values().at(0),
                       error.values().at(1));
  return "";
}

}  // namespace astro::commands
