#include <memory>

#include "host/base/error.hpp"
#include "host/commands/experiment/commands.hpp"
#include "host/commands/shared/damaged_option.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/console/options.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/recording/csv_export.hpp"
#include "host/recording/rosbag_export.hpp"
#include "host/recording/run_file.hpp"
#include "host/recording/run_folder.hpp"
#include "host/recording/tum_export.hpp"

namespace astro::commands {
namespace {

namespace fs = std::filesystem;

struct ExportOptions {
  fs::path recordings, csv, tum, rosbag;
  bool damaged = false;
};

/// Each recording of a folder gets a folder of its own, named and placed like it.
void run(const ExportOptions& options) {
  if (options.csv.empty() && options.tum.empty() && options.rosbag.empty())
    throw console::WrongUsage("name a folder with --csv, --tum or --rosbag");
  const bool many = fs::is_directory(options.recordings);
  const auto files = many ? recording::list_runs(options.recordings) : std::vector{options.recordings};
  for (const fs::path& file : files) {
    const recording::Run run = read_recordings(
        options.damaged, [&](recording::Damage damage) { return recording::read_run(file, damage); });
    warn_of_recordings({run});
    const fs::path own = many ? fs::relative(file, options.recordings).replace_extension() : fs::path();
    if (!options.csv.empty()) recording::export_csv(run, options.csv / own);
    if (!options.tum.empty()) recording::export_tum(run, options.tum / own);
    if (!options.rosbag.empty()) recording::export_rosbag(run, options.rosbag / own);
  }
  for (const fs::path& folder : {options.csv, options.tum, options.rosbag})
    if (!folder.empty()) print_path(fs::absolute(folder));
}

}  // namespace

void add_export(console::Command app) {
  const auto options = std::make_shared<ExportOptions>();
  const console::Command command =
      app.add_subcommand("export", "write recordings for spreadsheets, PlotJuggler, evo, RViz");
  command.add_option("recording", options->recordings, "a recording, or a folder of them").required();
  command
      .add_option("--csv", options->csv,
                  "write odometry.csv and truth.csv into this folder;\nof a folder, a folder inside it for "
                  "each recording")
      .type_name("FOLDER");
  command
      .add_option("--tum", options->tum,
                  "write odometry.tum and truth.tum into this folder:\nthe poses that have a heading")
      .type_name("FOLDER");
  command
      .add_option("--rosbag", options->rosbag,
                  "write a bag for 'ros2 bag play' into this new folder:\n/odom, /tf, /joint_states, /truth, "
                  "/robot_description")
      .type_name("FOLDER");
  add_damaged_flag(command, options->damaged);
  console::examples(command, {"astrolabe export drive.mcap --csv drive",
                              "astrolabe export my-experiment --csv my-experiment/csv",
                              "astrolabe export drive.mcap --rosbag drive-bag --tum drive-tum"});
  command.callback([options] { run(*options); });
}

}  // namespace astro::commands
