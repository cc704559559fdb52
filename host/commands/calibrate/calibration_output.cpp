#include "host/commands/calibrate/calibration_output.hpp"

#include "host/commands/calibrate/calibration_view.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/console/console.hpp"
#include "host/experiment/analysis/calibration_file.hpp"
#include "host/experiment/analysis/json.hpp"

namespace astro::commands {

void add_output(console::Command command, CalibrationOutput& output) {
  command.add_option("--out", output.file, "write the result here, for 'astrolabe upload'");
  command.add_flag("--json", output.json, "print the result as one JSON object");
}

void put_out(const experiment::Calibration& found, const CalibrationOutput& output) {
  if (!output.file.empty()) {
    experiment::write_calibration(output.file, found);
    console::say("written to " + output.file.string() + "; load it with: astrolabe upload " +
                 output.file.string());
  }
  if (output.json) {
    print_json(experiment::to_json(found));
  } else {
    write(calibration_text(found));
  }
}

}  // namespace astro::commands
