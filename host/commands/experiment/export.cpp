#include <memory>

#include "host/base/error.hpp"
#include "host/commands/experiment/commands.hpp"
#include "host/commands/shared/damaged_option.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/console/options.hpp"
#include "host/recording/files/csv_export.hpp"
#include "host/recording/files/run_file.hpp"
#include "host/recording/files/run_folder.hpp"

namespace astro::commands {
namespace {

namespace fs = std::filesystem;

struct ExportOptions {
  fs::path recordings, csv;
  bool damaged = false;
};

/// Each recording of a folder gets a folder of its own, named and placed like it.
void run(const ExportOptions& options) {
  const bool many = fs::is_directory(options.recordings);
  const auto files = many ? recording::list_runs(options.recordings) : std::vector{options.recordings};
  for (const fs::path& file : files) {
    const recording::Run run = read_recordings(
        options.damaged, [&](recording::Damage damage) { return recording::read_run(file, damage); });
    warn_of_recordings({run});
    const fs::path own = many ? fs::relative(file, options.recordings).replace_extension() : fs::path();
    recording::export_csv(run, options.csv / own);
  }
  print_path(fs::absolute(options.csv));
}

}  // namespace

void add_export(console::Command app) {
  const auto options = std::make_shared<ExportOptions>();
  const console::Command command =
      app.add_subcommand("export", "write recordings as tables for spreadsheets and PlotJuggler");
  command.add_option("recording", options->recordings, "a recording, or a folder of them").required();
  command
      .add_option("--csv", options->csv,
                  "write odometry.csv and truth.csv into this folder;\nof a folder, a folder inside it for "
                  "each recording")
      .type_name("FOLDER")
      .required();
  add_damaged_flag(command, options->damaged);
  console::examples(command, {"astrolabe export drive.mcap --csv drive",
                              "astrolabe export my-experiment --csv my-experiment/csv"});
  command.callback([options] { run(*options); });
}

}  // namespace astro::commands
