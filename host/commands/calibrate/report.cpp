#include <memory>

#include "host/base/error.hpp"
#include "host/commands/calibrate/commands.hpp"
#include "host/commands/shared/damaged_option.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/console/console.hpp"
#include "host/experiment/analysis/report_input.hpp"
#include "host/report/sections/report.hpp"

namespace astro::commands {

void add_report(console::Command app) {
  struct Options {
    std::vector<std::filesystem::path> folders;
    std::filesystem::path out;
    bool damaged = false;
  };
  const auto options = std::make_shared<Options>();
  const console::Command command =
      app.add_subcommand("report", "write the before/after report as one HTML file");
  command
      .add_option("folders", options->folders, "an experiment's folder, or two or more folders of recordings")
      .required();
  command.add_option("--out", options->out, "the file to write (default: report.html in the first folder)");
  add_damaged_flag(command, options->damaged);
  command.footer(
      "Examples:\n"
      "  astrolabe report my-experiment\n"
      "  astrolabe report monday/before friday/after --out report.html");
  command.callback([options] {
    const experiment::Results results = read_results_of(options->folders, options->damaged);
    const std::filesystem::path out =
        options->out.empty() ? options->folders.front() / "report.html" : options->out;
    report::write_report(out, experiment::report_input(results));
    print_path(std::filesystem::absolute(out));
  });
}

}  // namespace astro::commands
