#pragma once

#include <filesystem>
#include <functional>

#include "host/film/picture/film_info.hpp"

namespace astro::film {

/// Why no tag is read in a film.
enum class TagProblem { none_there, mirrored, too_small, blurred };

struct TagDiagnosis {
  TagProblem problem = TagProblem::none_there;
  double side_px = 0;  // of a tag that is too small or blurred
};

/// Searches some key pictures, mirrored, enlarged and reduced, for a tag with a wanted id. If there is none,
/// checks whether anything in the pictures is sharp.
///
/// Cost  about one second for each of at most six pictures.
TagDiagnosis why_no_tag(const std::filesystem::path& film, const FilmInfo& info,
                        const std::function<bool(int id)>& wanted);

}  // namespace astro::film
