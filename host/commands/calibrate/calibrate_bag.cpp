#include <algorithm>
#include <memory>

#include "host/base/files.hpp"
#include "host/commands/calibrate/calibration_output.hpp"
#include "host/commands/calibrate/commands.hpp"
#include "host/commands/calibrate/ml_option.hpp"
#include "host/commands/calibrate/scan_truth.hpp"
#include "host/commands/shared/import_options.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/experiment/analysis/calibration.hpp"
#include "host/import/scans/bag_scans.hpp"

namespace astro::commands {
namespace {

/// Each bag's truth is the scans in it.
ImportOptions with_scans(ImportOptions options) {
  for (const std::filesystem::path& bag : options.wheels) options.truth.push_back("scan:" + bag.string());
  return options;
}

}  // namespace

void add_calibrate_bag(console::Command calibrate) {
  struct Options {
    ImportOptions import;
    CalibrationOutput output;
    MlOption ml;
    ScanOptions scans;
  };
  const auto options = std::make_shared<Options>();
  const console::Command command = calibrate.add_subcommand(
      "bag",
      "from bags of ROS 1 or 2 that hold the wheels, and a tracker's poses\nor scans of a laser scanner");
  command.add_option("bags", options->import.wheels, "a bag for each drive: .bag, .mcap, .db3 or a folder")
      .required();
  add_bag_choices(command, options->import);
  add_bag_truth_choices(command, options->import);
  add_tracker_choices(command, options->import);
  add_geometry_choices(command, options->import);
  add_session_flag(command, options->import.session_per_folder);
  add_scan_options(command, options->scans);
  add_output(command, options->output);
  add_report_file(command, options->output);
  add_ml(command, options->ml);
  command.footer(
      "Sizes that are not given are those of the robot_description (URDF) that was recorded in the bag.\n"
      "Examples:\n"
      "  astrolabe calibrate bag drive1 drive2 --out calib.toml\n"
      "  astrolabe calibrate bag drive1 drive2 --robot diff_drive.yaml --out calib.toml\n"
      "  astrolabe calibrate bag drive.mcap --wheels-topic /joint_states --truth-topic /tracker/pose \\\n"
      "    --wheel-diameter 0.066 --wheelbase 0.16\n"
      "  astrolabe calibrate bag drive.bag --wheels-topic /left_ticks,/right_ticks --counts-per-turn 1440 "
      "\\\n"
      "    --wheel-diameter 0.066 --wheelbase 0.16\n"
      "Bags without poses of a tracker, but with scans of a laser scanner on the robot, are calibrated by "
      "those:\n"
      "  astrolabe calibrate bag drive.mcap --scan-topic /scan --wheel-diameter 0.066 --wheelbase 0.16\n"
      "  astrolabe inspect drive.mcap");
  command.callback([options] {
    ImportOptions& import = options->import;
    require_no_input(options->output.file, {import.robot_file});
    const bool by_scans =
        !options->scans.topic.empty() ||
        (import.truth_topic.empty() && import.frames.empty() &&
         std::all_of(import.wheels.begin(), import.wheels.end(), importing::has_scans_alone));
    if (by_scans && options->ml.given())
      throw console::WrongUsage("--K, --sigma-xy, --sigma-theta and --clock do not apply to scans");
    if (by_scans) return calibrate_by_scans(with_scans(import), options->output, options->scans);
    if (options->scans.given())
      throw console::WrongUsage(
          "--range-scale-error and --loaded-scale-error are of scans, and these bags have poses");
    import.truth = import.wheels;
    const experiment::RunSet set = read_drive_files(options->import);
    put_out(experiment::calibrate(set, {experiment::MethodChoice::Family::ml, {}}, options->ml.choice()), set,
            options->output);
  });
}

}  // namespace astro::commands
