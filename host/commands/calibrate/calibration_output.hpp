#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "host/console/command_line.hpp"
#include "host/experiment/analysis/calibration.hpp"
#include "host/experiment/analysis/gyro_runs.hpp"
#include "host/report/report.hpp"

namespace astro::commands {

/// --out, --report and --json of the commands that calibrate: where the result goes.
struct CalibrationOutput {
  std::filesystem::path file;    // empty: it is printed only
  std::filesystem::path report;  // empty: none
  bool json = false;
};
void add_output(console::Command command, CalibrationOutput& output);
/// --report, of commands that have whole drives.
void add_report_file(console::Command command, CalibrationOutput& output);

/// Makes the report of a calibration.
using MakeReport = std::function<report::ReportInput()>;

/// Writes the calibration and its report into their files, if these are named, and prints it as text or JSON. The program then ends
/// with the code for "no" if the drives advise against loading it.
void put_out(const experiment::Calibration& found, const CalibrationOutput& output,
             const MakeReport& make_report = {}, const std::optional<experiment::GyroResult>& gyro = {});

/// The same of the drives from which it was found. Throws console::WrongUsage if a report is named and the method takes end poses.
void put_out(const experiment::Calibration& found, const experiment::RunSet& set,
             const CalibrationOutput& output);

}  // namespace astro::commands
