#include <memory>

#include "host/base/text/columns.hpp"
#include "host/commands/experiment/commands.hpp"
#include "host/commands/shared/results_option.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/console/console.hpp"
#include "host/experiment/analysis/results.hpp"

#include <nlohmann/json.hpp>

namespace astro::commands {

void add_compare(console::Command app) {
  struct Options {
    ResultsOption results;
    bool json = false;
  };
  const auto options = std::make_shared<Options>();
  const console::Command command =
      app.add_subcommand("compare", "put recorded squares side by side: before, after, ...");
  add_results(command, options->results).required();
  command.add_flag("--json", options->json, "print one JSON object");
  command.footer(
      "Examples:\n"
      "  astrolabe compare my-experiment\n"
      "  astrolabe compare monday/before friday/after --json");
  command.callback([options] {
    const experiment::Results results = read_results(options->results);
    if (options->json) {
      print_json(experiment::to_json(results));
      return;
    }
    write(console::table(experiment::before_after_table(results)));
    if (results.phases.size() > 1) write('\n' + wrapped(results.verdict()));
  });
}

}  // namespace astro::commands
