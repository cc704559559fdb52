#include "host/commands/calibrate/calibration_output.hpp"

#include "host/commands/shared/calibration_view.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/console/console.hpp"
#include "host/console/program.hpp"
#include "host/experiment/analysis/calibration_file.hpp"
#include "host/experiment/analysis/json.hpp"
#include "host/experiment/analysis/judgement_sentences.hpp"

namespace astro::commands {

void add_output(console::Command command, CalibrationOutput& output) {
  command.add_option("--out", output.file, "write the result here, for 'astrolabe upload'");
  command.add_flag("--json", output.json, "print the result as one JSON object");
}

void put_out(const experiment::Calibration& found, const CalibrationOutput& output) {
  if (!output.file.empty()) {
    experiment::write_calibration(output.file, found);
    const bool use = !experiment::advises_against(found.judgement.verdict);
    console::say("written to " + output.file.string() +
                 (use ? "; load it with: astrolabe upload " + output.file.string()
                      : ", although it is not shown to be better than what the robot carries"));
  }
  if (output.json) {
    print_json(experiment::to_json(found));
  } else {
    write(calibration_text(found));
  }
  if (experiment::advises_against(found.judgement.verdict)) console::answer_no();
}

}  // namespace astro::commands
