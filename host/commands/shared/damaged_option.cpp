#include "host/commands/shared/damaged_option.hpp"

#include "host/commands/base/advice.hpp"
#include "host/console/console.hpp"

namespace astro::commands {

void add_damaged_flag(console::Command command, bool& damaged) {
  command.add_flag("--damaged", damaged, "use what can be read of damaged recordings");
}

void warn_of_recordings(const std::vector<recording::Run>& runs) {
  for (const recording::Run& run : runs)
    if (run.warning) console::say("warning: " + in_words(*run.warning));
}

}  // namespace astro::commands
