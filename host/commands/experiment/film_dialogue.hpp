#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/commands/shared/film_options.hpp"
#include "host/commands/shared/press_enter.hpp"
#include "host/experiment/files/plan.hpp"
#include "host/experiment/files/run_set.hpp"

/// What is said to, and asked of, a person who films an experiment.
namespace astro::commands {

/// Before the first run: how to film, for how long the robot drives, and where. Nothing if all is driven. Lines of at most 80 columns.
std::string film_briefing(const experiment::Plan& plan, const std::filesystem::path& folder,
                          double wheelbase_m);

/// Before the first run of a phase: waits for Enter alone, the phone films.
void ask_filming(const AskLine& ask, const std::string& phase);

struct FilmRequest {
  std::optional<std::filesystem::path> file;  // taken without a question, if it is there
  FilmOptions figures;
  std::vector<std::string> others;  // films that show the runs of other phases
};

/// Gives the runs of a phase the truth of the film that shows them, or of several. Asks for it until one of them is in the film; what
/// is wrong with a film is said. Throws astro::Error if nobody can be asked or the answer is empty: the same command goes on later.
void take_films(const std::string& phase, experiment::RunSet& set, const FilmRequest& request);

}  // namespace astro::commands
