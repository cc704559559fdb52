#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "host/base/error.hpp"
#include "host/calibration/end_poses/end_pose_csv.hpp"
#include "host/calibration/end_poses/odd_run.hpp"
#include "host/commands/calibrate/calibrate_check.hpp"
#include "host/commands/calibrate/calibrate_export.hpp"
#include "host/commands/calibrate/calibration_view.hpp"
#include "host/commands/calibrate/commands.hpp"
#include "host/console/console.hpp"
#include "host/commands/shared/damaged_option.hpp"
#include "host/commands/calibrate/method_option.hpp"
#include "host/console/options.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/experiment/analysis/calibration_file.hpp"
#include "host/experiment/analysis/json.hpp"
#include "host/base/files.hpp"

namespace astro::commands {
namespace {

namespace fs = std::filesystem;

struct MlOptions {
  calibration::NoiseModel noise;
  double sigma_theta_deg = 0;
  std::string clock;
  console::Option noise_option, clock_option;
  bool given() const { return noise_option.count() + clock_option.count() > 0; }
};

struct CalibrateOptions {
  fs::path cw, ccw, folder, out;
  std::vector<std::string> without;
  MlOptions ml;
  double side_m = 0;
  double wheelbase_m = 0;
  double c_r = 1, c_l = 1;
  MethodOption method;
  bool json = false, damaged = false;
};

void add_result(console::Command command, CalibrateOptions& options) {
  command.add_option("--out", options.out, "write the result here, for 'astrolabe upload'");
  command.add_flag("--json", options.json, "print the result as one JSON object");
}

void add_ml(console::Command command, CalibrateOptions& options) {
  MlOptions& ml = options.ml;
  const console::Option K =
      command.add_option("--K", ml.noise.K_m, "ml: wheel slip, variance per metre, m").check(console::positive("m"));
  const console::Option xy =
      command.add_option("--sigma-xy", ml.noise.sigma_xy_m, "ml: noise of ground truth per coordinate, m")
          .check(console::positive("m"));
  const console::Option theta =
      command
          .add_option("--sigma-theta", ml.sigma_theta_deg,
                      "ml: noise of its heading, degrees; without all\nthree the noise is estimated")
          .check(console::positive("degrees"));
  K.needs(xy).needs(theta);
  xy.needs(K).needs(theta);
  theta.needs(K).needs(xy);
  ml.noise_option = K;
  ml.clock_option = command
                        .add_option("--clock", ml.clock,
                                    "ml: known: ground truth has the robot's times;\n"
                                    "estimated: offsets and skew are found;\n"
                                    "default: what the recordings say")
                        .one_of({"known", "estimated"});
}

experiment::MlChoice ml_choice(const MlOptions& options) {
  using Clock = experiment::MlChoice::Clock;
  experiment::MlChoice choice;
  if (options.noise_option.count() > 0) {
    choice.noise = options.noise;
    choice.noise->sigma_theta_rad = options.sigma_theta_deg * std::numbers::pi / 180;
  }
  if (options.clock_option.count() > 0)
    choice.clock = options.clock == "known" ? Clock::known : Clock::estimated;
  return choice;
}

std::string read_text(const fs::path& path) {
  const recording::Bytes bytes = recording::load_file(path);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void finish(const experiment::Calibration& found, const CalibrateOptions& options) {
  if (!options.out.empty()) {
    experiment::write_calibration(options.out, found);
    console::say("written to " + options.out.string() + "; load it with: astrolabe upload " + options.out.string());
  }
  if (options.json) {
    print_json(experiment::to_json(found));
  } else {
    write(calibration_text(found));
  }
}

std::vector<calibration::EndPose> end_poses(const fs::path& file, double side_m) {
  const std::vector<calibration::EndPose> poses = calibration::read_end_poses(read_text(file), file.string());
  if (const auto odd = calibration::mistyped_run(poses, side_m))
    throw Error(fmt::format("{}: run {} has {} Correct it, or leave the run out", file.string(),
                            odd->index + 1, described(*odd)));
  for (const calibration::EndPose& pose : poses)
    if (const double off_m = std::hypot(pose.x_m, pose.y_m); side_m > 0 && off_m > side_m)
      throw Error(
          fmt::format("{}: a run of a square of {} m is off by {:.3g} m, which no robot is: name the "
                      "columns by their unit, ex_mm or ex_m",
                      file.string(), side_m, off_m));
  return poses;
}

void add_end_poses(console::Command calibrate) {
  const auto options = std::make_shared<CalibrateOptions>();
  const console::Command command =
      calibrate.add_subcommand("end-poses", "from measured end-pose errors of squares (CSV)");
  command
      .add_option("--cw", options->cw,
                  "clockwise runs: columns ex_mm|ex_m, ey_mm|ey_m, etheta_rad|etheta_deg")
      .required();
  command.add_option("--ccw", options->ccw, "counter-clockwise runs, the same columns").required();
  // As a robot can drive and carry it: 3000 and 290 are millimetres.
  command.add_option("--side", options->side_m, "side of the square, m")
      .check(console::between(0.1, 100, "m"))
      .required();
  command.add_option("--wheelbase", options->wheelbase_m, "wheelbase that the robot believed in, m")
      .check(console::between(0.05, 2, "m"))
      .required();
  command.add_option("--c-right", options->c_r, "c_R that the robot carried")
      .check(console::between(0.5, 1.5, ""))
      .capture_default_str();
  command.add_option("--c-left", options->c_l, "c_L that the robot carried")
      .check(console::between(0.5, 1.5, ""))
      .capture_default_str();
  add_method(command, options->method, {"auto", "umbmark", "extended", "least-squares"},
             "auto: extended where every run has an end heading,\numbmark where not");
  add_result(command, *options);
  command.footer(
      "An error is absolute (tape measure, mocap) minus odometry, at the end, in the run's start frame.\n"
      "Examples:\n"
      "  astrolabe calibrate end-poses --cw cw.csv --ccw ccw.csv --side 3 --wheelbase 0.29\n"
      "  astrolabe calibrate end-poses --cw cw.csv --ccw ccw.csv --side 3 --wheelbase 0.29 --method umbmark "
      "--angles x --out calib.toml");
  command.callback([options] {
    const experiment::MethodChoice method = options->method.choice();
    experiment::Squares squares;
    squares.cw = end_poses(options->cw, options->side_m);
    squares.ccw = end_poses(options->ccw, options->side_m);
    squares.side_m = options->side_m;
    squares.carried = {options->c_r, options->c_l, options->wheelbase_m};
    finish(experiment::calibrate(squares, method), *options);
  });
}

experiment::Calibration calibrate_runs(const CalibrateOptions& options) {
  const experiment::MethodChoice method = options.method.choice();
  const experiment::RunSet set = read_recordings(options.damaged, [&](recording::Damage damage) {
    return experiment::read_run_set(options.folder, options.without, damage);
  });
  warn_of_recordings(set.runs);
  experiment::Calibration found = experiment::calibrate(set, method, ml_choice(options.ml));
  if (found.ml() == nullptr && options.ml.given())
    throw Error(
        fmt::format("--K, --sigma-xy, --sigma-theta and --clock are of maximum likelihood, and this "
                    "is {}: leave them out",
                    found.method()));
  return found;
}

void add_runs(console::Command calibrate) {
  const auto options = std::make_shared<CalibrateOptions>();
  const console::Command command = calibrate.add_subcommand("runs", "from recorded runs with ground truth (MCAP)");
  command.add_option("folder", options->folder, "folder with the recordings").required();
  add_method(command, options->method, {"auto", "ml", "umbmark", "extended", "least-squares"},
             "ml: maximum likelihood over whole drives of any\n"
             "kind; the others: from end poses of squares; auto:\n"
             "ml where ground truth followed every run, else\n"
             "extended or umbmark");
  add_result(command, *options);
  add_ml(command, *options);
  command.add_option("--without", options->without, "a recording to leave out, by its name (repeatable)")
      .one_each_time();
  add_damaged_flag(command, options->damaged);
  command.footer(
      "ml finds c_R, c_L and b themselves, from runs of one phase or of several. The\n"
      "other methods find how they differ from what the robot carried, from the\n"
      "squares of one phase.\n"
      "Examples:\n"
      "  astrolabe calibrate runs my-experiment/before --out calib.toml\n"
      "  astrolabe calibrate runs my-experiment --without before/square-cw-3\n"
      "  astrolabe calibrate runs my-experiment/before --method umbmark --angles average --json");
  command.callback([options] { finish(calibrate_runs(*options), *options); });
}

}  // namespace

void add_calibrate(console::Command app) {
  const console::Command command =
      app.add_subcommand("calibrate", "compute c_R, c_L and b from recorded or measured runs");
  command.require_subcommand(1, 1);
  command.footer(
      "Examples:\n"
      "  astrolabe calibrate runs my-experiment/before --out calib.toml\n"
      "  astrolabe calibrate end-poses --help\n"
      "  astrolabe calibrate check other-drives --with calib.toml\n"
      "  astrolabe calibrate export calib.toml --to calib.yaml");
  add_runs(command);
  add_end_poses(command);
  add_calibrate_check(command);
  add_calibrate_export(command);
}

}  // namespace astro::commands
