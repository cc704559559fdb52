#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <vector>

#include "host/base/error.hpp"
#include "host/calibration/end_poses/end_pose_csv.hpp"
#include "host/calibration/end_poses/end_pose_problem.hpp"
#include "host/calibration/end_poses/misfit.hpp"
#include "host/calibration/end_poses/odd_run.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/calibrate/calibration_output.hpp"
#include "host/commands/calibrate/commands.hpp"
#include "host/commands/shared/method_option.hpp"
#include "host/console/options.hpp"
#include "host/experiment/analysis/calibration.hpp"
#include "host/formats/tables/text_file.hpp"

namespace astro::commands {
namespace {

namespace fs = std::filesystem;

struct EndPosesOptions {
  fs::path cw, ccw;
  CalibrationOutput output;
  double side_m = 0;
  double wheelbase_m = 0;
  double c_r = 1, c_l = 1, e = 0;
  bool keep_odd = false;
  MethodOption method;
};

/// Reads the table of the runs of one direction into `poses`, and where each is from into `from`.
void read_end_poses(const fs::path& file, Sense sense, double side_m,
                    std::vector<calibration::EndPose>& poses, std::vector<std::string>& from) {
  calibration::EndPoseTable table =
      calibration::read_end_poses(as_text(tables::text_of_file(file)), file.string(), sense);
  for (const int line : table.lines) from.push_back(fmt::format("{}, line {}", file.string(), line));
  poses = std::move(table.poses);
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (const double off_m = std::hypot(poses[i].x_m, poses[i].y_m); side_m > 0 && off_m > side_m)
      throw Error(fmt::format(
          "{}: a run of a square of {} m has an error of {:.3g} m, more than any robot's: name the "
          "columns by their unit, ex_mm or ex_m",
          from[i], side_m, off_m));
}

std::vector<calibration::SquareEnd> ends_of(const std::vector<calibration::EndPose>& errors) {
  std::vector<calibration::SquareEnd> ends;
  for (const calibration::EndPose& error : errors) ends.push_back({error});
  return ends;
}

/// Throws for runs of which all together, or one, would fit with a mistake that is easily made and easily corrected, such as
/// exchanged files or a moved decimal point. An odd end without such an explanation is accepted.
void refuse_mistakes(const experiment::Squares& squares) {
  using calibration::EndPoseProblem;
  const auto misfit = calibration::misfit_of(squares.cw, squares.ccw, {squares.side_m, squares.loaded});
  if (misfit && misfit->kind != Kind(EndPoseProblem::misfit)) throw Error(*misfit);
  for (const calibration::OddRun& odd :
       calibration::odd_runs(ends_of(squares.cw), ends_of(squares.ccw), {squares.side_m, squares.loaded}))
    if (odd.mistake)
      throw Error(
          fmt::format("{}: run {} has {}. Correct it, leave the run out, or keep it as it is with "
                      "--keep-odd",
                      (odd.sense == Sense::cw ? squares.cw_from : squares.ccw_from)[odd.index], odd.index + 1,
                      described(odd)));
}

constexpr Advice kEndPosesAdvice[] = {
    {calibration::EndPoseProblem::same_runs, ": name the other file, or keep them with --keep-odd"},
    {calibration::EndPoseProblem::misfit_with_mistake,
     ": correct it, or keep the runs as they are with --keep-odd"}};

}  // namespace

void add_calibrate_end_poses(console::Command calibrate) {
  advise(kEndPosesAdvice);
  const auto options = std::make_shared<EndPosesOptions>();
  const console::Command command =
      calibrate.add_subcommand("end-poses", "from measured end-pose errors of squares (CSV)");
  command
      .add_option("--cw", options->cw,
                  "clockwise runs: columns ex_mm|ex_m, ey_mm|ey_m, etheta_rad|etheta_deg")
      .required();
  command.add_option("--ccw", options->ccw, "counter-clockwise runs, the same columns").required();
  // Limits of real robots, so that 3000 or 290 (in millimetres) are refused.
  command.add_option("--side", options->side_m, "side of the square, m")
      .check(console::between(0.1, 100, "m"))
      .required();
  command.add_option("--wheelbase", options->wheelbase_m, "wheelbase that was loaded in the robot, m")
      .check(console::between(0.05, 2, "m"))
      .required();
  command.add_option("--c-right", options->c_r, "c_R that was loaded in the robot")
      .check(console::between(0.5, 1.5, ""))
      .capture_default_str();
  command.add_option("--c-left", options->c_l, "c_L that was loaded in the robot")
      .check(console::between(0.5, 1.5, ""))
      .capture_default_str();
  command.add_option("--e", options->e, "e that was loaded in the robot; it stays as it is")
      .check(console::between(-0.2, 0.2, ""))
      .capture_default_str();
  command.add_flag("--keep-odd", options->keep_odd, "take runs as they are that seem mistyped");
  add_method(command, options->method, {"auto", "umbmark", "extended", "least-squares", "robust"},
             "auto: robust");
  add_output(command, options->output);
  command.footer(
      "An error is absolute (tape measure, mocap) minus odometry, at the end, in the run's start frame.\n"
      "Examples:\n"
      "  astrolabe calibrate end-poses --cw cw.csv --ccw ccw.csv --side 3 --wheelbase 0.29\n"
      "  astrolabe calibrate end-poses --cw cw.csv --ccw ccw.csv --side 3 --wheelbase 0.29 --method umbmark "
      "--angles x --out calib.toml");
  command.callback([options] {
    const experiment::MethodChoice method = options->method.choice();
    experiment::Squares squares;
    read_end_poses(options->cw, Sense::cw, options->side_m, squares.cw, squares.cw_from);
    read_end_poses(options->ccw, Sense::ccw, options->side_m, squares.ccw, squares.ccw_from);
    squares.side_m = options->side_m;
    squares.loaded = {options->c_r, options->c_l, options->wheelbase_m, options->e};
    if (!options->keep_odd) refuse_mistakes(squares);
    put_out(experiment::calibrate(squares, method), options->output);
  });
}

}  // namespace astro::commands
