#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/commands/shared/film_options.hpp"
#include "host/experiment/files/run_set.hpp"
#include "host/film/runs/film_truth.hpp"

/// Ground truth from films of printed tags: --truth film:FILE of the commands that calibrate and judge.
namespace astro::commands {

/// The file in "film:FILE"; nothing for any other word.
std::optional<std::filesystem::path> film_named(const std::string& word);

/// Adds --truth film:FILE (repeatable) and what was measured on the tags.
struct FilmTruthOption {
  std::vector<std::string> films;
  FilmOptions figures;
};
void add_film_truth(console::Command command, FilmTruthOption& option);

/// Follows each film, with progress. Throws what film::follow_film throws.
std::vector<film::NamedFilm> follow_films(const std::vector<std::filesystem::path>& films,
                                          const FilmOptions& figures);

/// The films as truth of the runs; says what was found. Throws what film::attach_films throws.
void give_truth(experiment::RunSet& set, const std::vector<film::NamedFilm>& films,
                const FilmOptions& figures);

/// Does both if films are named. Throws console::WrongUsage if figures of tags are given without a film.
void give_truth(experiment::RunSet& set, const FilmTruthOption& option);

/// Throws console::WrongUsage if figures of tags are given without a film.
void require_film_for(const FilmOptions& figures, bool film);

}  // namespace astro::commands
