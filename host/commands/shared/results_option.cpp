#include "host/commands/shared/results_option.hpp"

#include "host/commands/shared/damaged_option.hpp"
#include "host/console/console.hpp"

namespace astro::commands {

console::Option add_results(console::Command command, ResultsOption& option) {
  const console::Option folders =
      command
          .add_option("folders", option.folders,
                      "an experiment's folder, or two or more folders of recordings")
          .type_name("FOLDER");
  add_damaged_flag(command, option.damaged);
  return folders;
}

experiment::Results read_results(const ResultsOption& option) {
  const auto& folders = option.folders;
  experiment::Results results = read_recordings(option.damaged, [&](recording::Damage damage) {
    return folders.size() == 1 ? experiment::read_results(folders.front(), damage)
                               : experiment::read_folders(folders, damage);
  });
  for (const experiment::PhaseResult& phase : results.phases) warn_of_recordings(phase.runs());
  if (const std::string other = results.other_robot(); !other.empty()) console::say("warning: " + other);
  return results;
}

}  // namespace astro::commands
