#include "host/truth/tags/paper.hpp"

namespace astro::truth::tags {

std::optional<Paper> paper_named(std::string_view name) {
  for (const Paper& paper : {kA4, kLetter})
    if (paper.name == name) return paper;
  return std::nullopt;
}

}  // namespace astro::truth::tags
