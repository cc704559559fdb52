#include "host/commands/calibrate/calibration_output.hpp"

#include <fmt/format.h>

#include <vector>

#include "host/commands/shared/calibration_view.hpp"
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
             const MakeReport& make_report) {
  if (!output.file.empty()) {
    experiment::write_calibration(output.file, found);
    const bool use = !experiment::advises_against(found.judgement.verdict);
    console::say("written to " + output.file.string() +
                 (use ? "; load it with: astrolabe upload " + output.file.string()
                      : ", although it is not shown to be better than what the robot carries"));
  }
  if (!output.report.empty()) {
    report::write_report(output.report, make_report());
    console::say("report: " + std::filesystem::absolute(output.report).string());
  }
  if (output.json) {
    print_json(experiment::to_json(found));
  } else {
    write(calibration_text(found));
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
  put_out(found, output, [&] {
    if (found.ml() != nullptr) return importing::drive_report(set, found);
    std::vector<lidar::ScannedDrive> drives;
    for (std::size_t i = 0; i < set.runs.size(); ++i)
      drives.push_back(experiment::scanned_drive(set.runs[i], set.names[i]));
    return experiment::scan_report(found, drives, false);
  });
}

}  // namespace astro::commands
