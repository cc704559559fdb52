#include "host/commands/base/flags.hpp"

namespace astro::commands {

void add_force(console::Command command, bool& force) {
  command.add_flag("--force", force,
                   "upload also a change of more than 10 %, or on top of other\nparameters");
}

void add_json_flag(console::Command command, bool& json) {
  command.add_flag("--json", json, "print JSON instead of text for people");
}

}  // namespace astro::commands
