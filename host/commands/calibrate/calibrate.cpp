#include "host/commands/calibrate/commands.hpp"

namespace astro::commands {

void add_calibrate(console::Command app) {
  const console::Command command =
      app.add_subcommand("calibrate", "compute c_R, c_L and b from recorded or measured runs");
  command.require_subcommand(1, 1);
  command.footer(
      "Examples:\n"
      "  astrolabe calibrate runs my-experiment/before --out calib.toml\n"
      "  astrolabe calibrate files --wheels ticks.csv --truth take.csv --robot robot.toml\n"
      "  astrolabe calibrate bag drive1 drive2 --robot diff_drive.yaml\n"
      "  astrolabe calibrate end-poses --help\n"
      "  astrolabe calibrate check other-drives --with calib.toml\n"
      "  astrolabe calibrate export calib.toml --to calib.yaml");
  add_calibrate_runs(command);
  add_calibrate_files(command);
  add_calibrate_bag(command);
  add_calibrate_gyro(command);
  add_calibrate_end_poses(command);
  add_calibrate_check(command);
  add_calibrate_export(command);
}

}  // namespace astro::commands
