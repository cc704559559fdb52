#include <memory>

#include "host/base/files.hpp"
#include "host/commands/calibrate/calibration_output.hpp"
#include "host/commands/calibrate/commands.hpp"
#include "host/commands/calibrate/ml_option.hpp"
#include "host/commands/shared/import_options.hpp"
#include "host/experiment/analysis/calibration.hpp"

namespace astro::commands {

void add_calibrate_bag(console::Command calibrate) {
  struct Options {
    ImportOptions import;
    CalibrationOutput output;
    MlOption ml;
  };
  const auto options = std::make_shared<Options>();
  const console::Command command =
      calibrate.add_subcommand("bag", "from bags of ROS 1 or 2 that hold the wheels and a tracker's poses");
  command.add_option("bags", options->import.wheels, "a bag for each drive: .bag, .mcap, .db3 or a folder")
      .required();
  add_bag_choices(command, options->import);
  add_tracker_choices(command, options->import);
  add_geometry_choices(command, options->import);
  add_session_flag(command, options->import.session_per_folder);
  add_output(command, options->output);
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
      "  astrolabe inspect drive.mcap");
  command.callback([options] {
    options->import.truth = options->import.wheels;
    require_no_input(options->output.file, {options->import.robot_file});
    put_out(experiment::calibrate(read_drive_files(options->import),
                                  {experiment::MethodChoice::Family::ml, {}}, options->ml.choice()),
            options->output);
  });
}

}  // namespace astro::commands
