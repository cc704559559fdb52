#include "host/commands/shared/damaged_option.hpp"

#include "host/commands/base/advice.hpp"
#include "host/console/console.hpp"
#include "host/recording/run_metadata.hpp"
#include "host/recording/slip_remark.hpp"

namespace astro::commands {

void add_damaged_flag(console::Command command, bool& damaged) {
  command.add_flag("--damaged", damaged, "use what can be read of damaged recordings");
}

void warn_of_recordings(const std::vector<recording::Run>& runs) {
  for (const recording::Run& run : runs) {
    if (run.warning) console::say("warning: " + in_words(*run.warning));
    if (const auto slips = recording::slip_remark(run, recording::run_name(run.info)))
      console::say("warning: " + in_words(*slips));
  }
}

}  // namespace astro::commands
