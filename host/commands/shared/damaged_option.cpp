#include "host/commands/shared/damaged_option.hpp"

#include "host/console/console.hpp"

namespace astro::commands {

void add_damaged_flag(console::Command command, bool& damaged) {
  command.add_flag("--damaged", damaged, "use what can be read of damaged recordings");
}

void warn_of_recordings(const std::vector<recording::Run>& runs) {
  for (const recording::Run& run : runs)
    if (!run.warning.empty()) console::say("warning: " + run.warning);
}

experiment::Results read_results_of(const std::vector<std::filesystem::path>& folders, bool damaged) {
  experiment::Results results = read_recordings(damaged, [&](recording::Damage damage) {
    return folders.size() == 1 ? experiment::read_results(folders.front(), damage)
                               : experiment::read_folders(folders, damage);
  });
  for (const experiment::PhaseResult& phase : results.phases) warn_of_recordings(phase.runs());
  if (const std::string other = results.other_robot(); !other.empty()) console::say("warning: " + other);
  return results;
}

}  // namespace astro::commands
