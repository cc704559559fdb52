#pragma once

#include "host/console/command_line.hpp"

/// Options that mean the same in every command.
namespace astro::commands {

/// Adds --yes, which answers a question that the command otherwise asks before it acts. `answers`: the help,
/// which names the question.
void add_yes(console::Command command, bool& yes, const char* answers);

/// Adds --json.
void add_json_flag(console::Command command, bool& json);

}  // namespace astro::commands
