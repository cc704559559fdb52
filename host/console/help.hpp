#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace astro::console {

/// The help of `app`, and of the subcommands that it gets from here on, fits a terminal of 80 columns: descriptions are wrapped
/// beside the names, and an example that is longer goes on in a line of its own, as a shell reads it.
void fit_help(CLI::App& app);

/// The words of `text` in lines of at most 80 columns, of which the first begins at column `at`, and the others at column
/// `indent`.
std::string wrapped(std::string_view text, std::size_t at, std::size_t indent);

}  // namespace astro::console
