#include <memory>

#include "host/base/files.hpp"
#include "host/calibration/judgement/remarks.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/calibrate/calibration_output.hpp"
#include "host/commands/calibrate/commands.hpp"
#include "host/commands/calibrate/ml_option.hpp"
#include "host/commands/calibrate/scan_truth.hpp"
#include "host/commands/shared/import_options.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/experiment/analysis/calibration.hpp"

namespace astro::commands {
namespace {

constexpr Advice kFilesAdvice[] = {
    {calibration::JudgementProblem::slips_too_much, "; --swap-wheels exchanges the wheels"}};

}  // namespace

void add_calibrate_files(console::Command calibrate) {
  advise(kFilesAdvice);
  struct Options {
    ImportOptions import;
    CalibrationOutput output;
    MlOption ml;
    ScanOptions scans;
  };
  const auto options = std::make_shared<Options>();
  const console::Command command =
      calibrate.add_subcommand("files", "from wheels and ground truth that other programs recorded");
  add_import(command, options->import);
  add_scan_options(command, options->scans);
  add_output(command, options->output);
  add_report_file(command, options->output);
  add_ml(command, options->ml);
  command.footer(
      "For any differential-drive robot under any tracker. The clocks of both need not agree.\n"
      "Examples:\n"
      "  astrolabe calibrate files --wheels 1.csv --truth take1.csv --wheels 2.csv --truth take2.csv \\\n"
      "    --wheel-diameter 0.084 --counts-per-turn 2796.8 --wheelbase 0.2 --out calib.toml\n"
      "  astrolabe calibrate files --wheels ticks.csv --wheel-columns time_s,left_counts,right_counts \\\n"
      "    --per-interval --truth take.csv --body ASTRO --robot diff_drive.yaml\n"
      "  astrolabe inspect take.csv\n"
      "Where no tracker follows the robot, a table of two rows for each drive will do, the poses before and\n"
      "after it from a tape, in any frame that the robot's start and end share:\n"
      "  x_m,y_m,theta_deg\n"
      "  0,0,0\n"
      "  4.02,0.11,-1.5\n"
      "  astrolabe calibrate files --wheels 1.csv --truth ends1.csv --wheels 2.csv --truth ends2.csv \\\n"
      "    --wheel-diameter 0.084 --counts-per-turn 2796.8 --wheelbase 0.2 --out calib.toml\n"
      "Where the robot has a laser scanner, its scans will do, in a bag or in a log of CARMEN:\n"
      "  astrolabe calibrate files --wheels intel.log.gz --truth scan:intel.log.gz --wheelbase 0.4");
  command.callback([options] {
    if (!options->import.given())
      throw console::WrongUsage("no drives are named: give --wheels and --truth for each");
    require_no_input(options->output.file, {options->import.robot_file});
    if (names_scans(options->import) && options->ml.given())
      throw console::WrongUsage("--K, --sigma-xy, --sigma-theta and --clock do not apply to scans");
    if (names_scans(options->import))
      return calibrate_by_scans(options->import, options->output, options->scans);
    if (options->scans.given())
      throw console::WrongUsage(
          "--scan-topic, --range-scale-error and --loaded-scale-error do not apply here: no --truth is "
          "scan:FILE");
    const experiment::RunSet set = read_drive_files(options->import);
    put_out(experiment::calibrate(set, {experiment::MethodChoice::Family::ml, {}}, options->ml.choice()), set,
            options->output);
  });
}

}  // namespace astro::commands
