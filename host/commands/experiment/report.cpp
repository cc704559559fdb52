#include <memory>

#include "host/commands/experiment/commands.hpp"
#include "host/commands/shared/results_option.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/console/console.hpp"
#include "host/experiment/analysis/report_input.hpp"
#include "host/report/sections/report.hpp"

namespace astro::commands {

void add_report(console::Command app) {
  struct Options {
    ResultsOption results;
    std::filesystem::path out;
  };
  const auto options = std::make_shared<Options>();
  const console::Command command =
      app.add_subcommand("report", "write the before/after report as one HTML file");
  add_results(command, options->results);
  command.add_option("--out", options->out, "the file to write (default: report.html in the first folder)");
  command.footer(
      "Examples:\n"
      "  astrolabe report my-experiment\n"
      "  astrolabe report monday/before friday/after --out report.html");
  command.callback([options] {
    const experiment::Results results = read_results(options->results);
    const std::filesystem::path out =
        options->out.empty() ? options->results.folders.front() / "report.html" : options->out;
    report::write_report(out, experiment::report_input(results));
    print_path(std::filesystem::absolute(out));
  });
}

}  // namespace astro::commands
