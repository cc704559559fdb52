#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/commands/shared/film_options.hpp"
#include "host/commands/shared/press_enter.hpp"
#include "host/experiment/files/plan.hpp"
#include "host/experiment/files/run_set.hpp"

/// The dialogue with a person who films an experiment.
namespace astro::commands {

/// Before the first run: how to film, for how long the robot drives, and where. Empty if all runs are driven. Lines of at
/// most 80 columns.
std::string film_briefing(const experiment::Plan& plan, const std::filesystem::path& folder,
                          double wheelbase_m);

/// Before the first run of a phase: waits for Enter alone, by which the person confirms that the phone films.
void ask_filming(const AskLine& ask, const std::string& phase);

struct FilmRequest {
  std::optional<std::filesystem::path> file;  // taken without a question, if it is there
  FilmOptions figures;
  std::vector<std::string> others;  // films that show the runs of other phases
};

/// Adds the truth from the film or films that show the runs of a phase. Asks for films until at least one run is in them,
/// and says what is wrong with a film. Throws astro::Error if nobody can be asked or the answer is empty; the same command
/// resumes later.
void take_films(const std::string& phase, experiment::RunSet& set, const FilmRequest& request);

}  // namespace astro::commands
