#pragma once

namespace CLI {
class App;
}

namespace astro::console {

/// The help of `app`, and of the subcommands that it gets from here on, fits a terminal of 80 columns: descriptions are wrapped
/// beside the names, and an example that is longer goes on in a line of its own, as a shell reads it.
void fit_help(CLI::App& app);

}  // namespace astro::console
