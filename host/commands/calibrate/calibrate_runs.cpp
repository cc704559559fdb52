#include "host/commands/calibrate/calibrate_runs.hpp"

#include <fmt/format.h>

#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/commands/calibrate/calibration_output.hpp"
#include "host/commands/calibrate/method_option.hpp"
#include "host/commands/shared/damaged_option.hpp"
#include "host/console/options.hpp"
#include "host/experiment/analysis/calibration.hpp"
#include "host/experiment/files/run_set.hpp"

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

struct RunsOptions {
  fs::path folder;
  CalibrationOutput output;
  std::vector<std::string> without;
  MlOptions ml;
  MethodOption method;
  bool damaged = false;
};

void add_ml(console::Command command, RunsOptions& options) {
  MlOptions& ml = options.ml;
  const console::Option K = command.add_option("--K", ml.noise.K_m, "ml: wheel slip, variance per metre, m")
                                .check(console::positive("m"));
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

experiment::Calibration calibrate_runs(const RunsOptions& options) {
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

}  // namespace

void add_calibrate_runs(console::Command calibrate) {
  const auto options = std::make_shared<RunsOptions>();
  const console::Command command =
      calibrate.add_subcommand("runs", "from recorded runs with ground truth (MCAP)");
  command.add_option("folder", options->folder, "folder with the recordings").required();
  add_method(command, options->method, {"auto", "ml", "umbmark", "extended", "least-squares"},
             "ml: maximum likelihood over whole drives of any\n"
             "kind; the others: from end poses of squares; auto:\n"
             "ml where ground truth followed every run, else\n"
             "extended or umbmark");
  add_output(command, options->output);
  add_ml(command, *options);
  command.add_option("--without", options->without, "a recording to leave out, by its name (repeatable)")
      .one_each_time();
  add_damaged_flag(command, options->damaged);
  command.footer(
      "ml finds c_R, c_L and b themselves, from runs of one phase or of several. The\n"
      "other methods find how they differ from the loaded ones, from the\n"
      "squares of one phase.\n"
      "Examples:\n"
      "  astrolabe calibrate runs my-experiment/before --out calib.toml\n"
      "  astrolabe calibrate runs my-experiment --without before/square-cw-3\n"
      "  astrolabe calibrate runs my-experiment/before --method umbmark --angles average --json");
  command.callback([options] { put_out(calibrate_runs(*options), options->output); });
}

}  // namespace astro::commands
