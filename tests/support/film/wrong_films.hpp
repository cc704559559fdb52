#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/support/film/film_set.hpp"

namespace astro::support::film {

/// Films of 9 s in 720p with 15 frames a second, each with one flaw.
std::vector<std::string> wrong_film_names();

/// Nothing if there is none of that name. film_case() has them, too.
std::optional<FilmCase> wrong_film(const std::string& name);

}  // namespace astro::support::film
