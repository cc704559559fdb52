#pragma once

#include <string>

namespace astro::commands {

/// The parameter table of this program's own version (common/params/table.hpp) as a page of Markdown in 80 columns.
std::string parameters_page();

}  // namespace astro::commands
