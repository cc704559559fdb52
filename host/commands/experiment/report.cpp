#include <memory>

#include "host/commands/experiment/commands.hpp"
#include "host/commands/shared/import_options.hpp"
#include "host/commands/shared/results_option.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/commands/shared/unused_choices.hpp"
#include "host/console/console.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/experiment/analysis/report_input.hpp"
#include "host/experiment/import/drive_report.hpp"
#include "host/report/sections/report.hpp"

namespace astro::commands {

namespace {

report::ReportInput of_drives(const ImportOptions& import, const std::filesystem::path& with) {
  const experiment::RunSet set = read_drive_files(import);
  const experiment::Calibration found =
      experiment::calibrate(set, {experiment::MethodChoice::Family::ml, {}});
  if (with.empty()) return experiment::drive_report(set, found);
  experiment::NamedFactors factors = experiment::factors_of_file(with, found.wheel.value());
  factors.name = with.filename().string();
  return experiment::drive_report(set, found, factors);
}

}  // namespace

void add_report(console::Command app) {
  struct Options {
    ResultsOption results;
    ImportOptions import;
    std::filesystem::path with, out;
  };
  const auto options = std::make_shared<Options>();
  const console::Command command =
      app.add_subcommand("report", "write the before/after report as one HTML file");
  add_results(command, options->results);
  add_import(command, options->import);
  command.add_option("--with", options->with, "--wheels: this calib.toml instead of one from the drives");
  command.add_option("--out", options->out, "the file to write (default: report.html in the first folder)");
  command.footer(
      "Examples:\n"
      "  astrolabe report my-experiment\n"
      "  astrolabe report --wheels ticks.csv --truth take.csv --robot robot.toml --with calib.toml\n"
      "  astrolabe report monday/before friday/after --out report.html");
  command.callback([options] {
    const bool files = options->import.given();
    if (files == !options->results.folders.empty())
      throw console::WrongUsage("name either folders of recordings, or --wheels and --truth of each drive");
    if (!files) refuse_choices_without_drives(options->import);
    if (!files && options->import.session_per_folder)
      throw console::WrongUsage("--session-per-folder goes with --wheels and --truth");
    if (!files && !options->with.empty()) throw console::WrongUsage("--with goes with --wheels and --truth");
    std::filesystem::path out = options->out;
    if (out.empty()) out = files ? "report.html" : options->results.folders.front() / "report.html";
    report::write_report(out, files ? of_drives(options->import, options->with)
                                    : experiment::report_input(read_results(options->results)));
    print_path(std::filesystem::absolute(out));
  });
}

}  // namespace astro::commands
