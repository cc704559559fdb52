#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/console/command_line.hpp"
#include "host/film/track/film_figures.hpp"

namespace astro::commands {

/// What a person measured on the printed tags of a film; lengths as typed, with or without a unit.
struct FilmOptions {
  unsigned robot_tag = 0;
  std::string tag_side, tag_height, floor_tag_side;
  std::vector<std::string> tapes;
  std::optional<double> readout_ms;

  bool given() const {
    return robot_tag != 0 || !tag_side.empty() || !tag_height.empty() || !floor_tag_side.empty() ||
           !tapes.empty() || readout_ms.has_value();
  }
};

/// --robot-tag, --tag-side, --tag-height, --floor-tag-side, --tape and --readout. `prefix` begins each text in the help of a
/// command for which a film is one of several sources.
void add_film_options(console::Command command, FilmOptions& options, const std::string& prefix = "");

/// Precondition: the options were checked as they were parsed.
film::FilmFigures figures_of(const FilmOptions& options);

}  // namespace astro::commands
