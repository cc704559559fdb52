#include "host/commands/base/flags.hpp"

namespace astro::commands {

void add_force(console::Command command, bool& force) {
  command.add_flag("--force", force,
                   "upload also what is not shown to be better, a change of more\n"
                   "than 10 %, and what is of another robot, of another wheel or\n"
                   "on top of other parameters");
}

void add_json_flag(console::Command command, bool& json) {
  command.add_flag("--json", json, "print JSON instead of text for people");
}

}  // namespace astro::commands
