#include "host/commands/calibrate/calibration_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/base/text/columns.hpp"
#include "host/commands/shared/calibration_view.hpp"
#include "host/commands/shared/gyro_view.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/console/console.hpp"
#include "host/console/program.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/experiment/analysis/calibration_file.hpp"
#include "host/experiment/analysis/json.hpp"
#include "host/experiment/analysis/judgement_sentences.hpp"
#include "host/experiment/analysis/scan_figures.hpp"
#include "host/experiment/analysis/scanned_runs.hpp"
#include "host/import/drives/drive_report.hpp"

namespace astro::commands {
void add_output(console::Command command, CalibrationOutput& output) {
  command.add_option("--out", output.file, "write the result here, for 'astrolabe upload'");
  command.add_flag("--json", output.json, "print the result as one JSON object");
}

void add_report_file(console::Command command, CalibrationOutput& output) {
  command.add_option("--report", output.report, "write a report with figures here, one HTML file");
}

void put_out(const experiment::Calibration& found, const CalibrationOutput& output,
             const MakeReport& make_report, const std::optional<experiment::GyroResult>& gyro) {
  if (!output.file.empty()) {
    experiment::write_calibration(output.file, found);
    const bool use = !experiment::advises_against(found.judgement.verdict);
    console::say("written to " + output.file.string() +
                 (use ? "; load it with: astrolabe upload " + output.file.string()
                      : ", although it is not shown to be better than what the robot carries"));
  }
  if (!output.report.empty()) {
    report::ReportInput input = make_report();
    if (gyro) std::ranges::move(experiment::notes_of(*gyro), std::back_inserter(input.notes));
    report::write_report(output.report, input);
    console::say("report: " + std::filesystem::absolute(output.report).string());
  }
  if (output.json) {
    nlohmann::json json = experiment::to_json(found);
    if (gyro) json["gyro"] = experiment::to_json(*gyro);
    print_json(json);
  } else {
    write(calibration_text(found));
    if (gyro) write('\n' + gyro_text(*gyro) + slips_text(gyro->against_wheels, gyro->names));
  }
  if (experiment::advises_against(found.judgement.verdict)) console::answer_no();
}

void put_out(const experiment::Calibration& found, const experiment::RunSet& set,
             const CalibrationOutput& output) {
  if (!output.report.empty() && found.end_poses() != nullptr)
    throw console::WrongUsage(fmt::format(
        "--report is of whole drives, and --method {} takes the ends of squares: leave it out; 'astrolabe "
        "report' shows squares",
        found.method()));
  put_out(
      found, output,
      [&] {
        if (found.ml() != nullptr) return importing::drive_report(set, found);
        return experiment::scan_report(found, experiment::scanned_drives(set), false);
      },
      gyro_of(set, found));
}

}  // namespace astro::commands
