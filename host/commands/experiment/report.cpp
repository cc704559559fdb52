#include <memory>

#include "host/commands/base/advice.hpp"
#include "host/commands/experiment/commands.hpp"
#include "host/commands/shared/damaged_option.hpp"
#include "host/commands/shared/film_truth.hpp"
#include "host/commands/shared/import_options.hpp"
#include "host/commands/shared/results_option.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/commands/shared/unused_choices.hpp"
#include "host/console/console.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/experiment/analysis/report_input.hpp"
#include "host/experiment/files/journal.hpp"
#include "host/import/drives/drive_report.hpp"
#include "host/report/report.hpp"

namespace astro::commands {

namespace {

/// Recordings of this project whose truth is a film.
experiment::RunSet read_filmed(const ResultsOption& results, const ImportOptions& import) {
  experiment::RunSet all;
  for (const std::filesystem::path& folder : results.folders) {
    experiment::RunSet set = read_recordings(results.damaged, [&](recording::Damage damage) {
      return experiment::read_run_set(folder, {}, damage);
    });
    const std::string before = results.folders.size() > 1 ? folder.filename().string() + "/" : "";
    for (std::size_t i = 0; i < set.runs.size(); ++i) {
      all.names.push_back(before + set.names[i]);
      all.runs.push_back(std::move(set.runs[i]));
    }
  }
  warn_of_recordings(all.runs);
  give_films(all, import);
  return all;
}

report::ReportInput of_drives(const experiment::RunSet& set, const std::filesystem::path& with) {
  const experiment::Calibration found =
      experiment::calibrate(set, {experiment::MethodChoice::Family::ml, {}});
  if (with.empty()) return importing::drive_report(set, found);
  experiment::NamedFactors factors = experiment::factors_of_file(with, found.wheel.value());
  factors.name = with.filename().string();
  return importing::drive_report(set, found, factors);
}

constexpr Advice kReportAdvice[] = {
    {experiment::JournalProblem::no_experiment,
     ": name the --out of 'astrolabe umbmark', or two or more folders of recordings"},
    {experiment::JournalProblem::damaged,
     ": the recordings beside it can still be calibrated with 'astrolabe calibrate runs'"},
};

}  // namespace

void add_report(console::Command app) {
  advise(kReportAdvice);
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
      "  astrolabe report drives --truth film:drives.mp4 --tag-height 121mm --tape 1:4=3.46\n"
      "  astrolabe report monday/before friday/after --out report.html");
  command.callback([options] {
    const bool files = options->import.given();
    if (files == !options->results.folders.empty())
      throw console::WrongUsage("name either folders of recordings, or --wheels and --truth of each drive");
    if (!files) refuse_choices_without_drives(options->import);
    if (!files && options->import.session_per_folder)
      throw console::WrongUsage("--session-per-folder goes with --wheels and --truth");
    const bool films = !options->import.films().empty();
    if (!files) require_film_for(options->import.film_figures, films);
    if (!files && !films && !options->with.empty())
      throw console::WrongUsage("--with goes with --wheels and --truth");
    std::filesystem::path out = options->out;
    if (out.empty()) out = files ? "report.html" : options->results.folders.front() / "report.html";
    report::ReportInput input;
    if (files)
      input = of_drives(read_drive_files(options->import), options->with);
    else if (films)
      input = of_drives(read_filmed(options->results, options->import), options->with);
    else
      input = experiment::report_input(read_results(options->results));
    report::write_report(out, input);
    print_path(std::filesystem::absolute(out));
  });
}

}  // namespace astro::commands
