#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/commands/calibrate/calibration_output.hpp"
#include "host/commands/calibrate/commands.hpp"
#include "host/commands/calibrate/ml_option.hpp"
#include "host/commands/shared/damaged_option.hpp"
#include "host/commands/shared/film_truth.hpp"
#include "host/commands/shared/import_options.hpp"
#include "host/commands/shared/method_option.hpp"
#include "host/experiment/analysis/calibration.hpp"
#include "host/experiment/files/folder_sessions.hpp"
#include "host/experiment/files/run_set.hpp"

namespace astro::commands {
namespace {

namespace fs = std::filesystem;

struct RunsOptions {
  fs::path folder;
  CalibrationOutput output;
  std::vector<std::string> without;
  MlOption ml;
  MethodOption method;
  FilmTruthOption film;
  bool damaged = false, session_per_folder = false;
};

experiment::Calibration calibrate_runs(const RunsOptions& options) {
  const experiment::MethodChoice method = options.method.choice();
  experiment::RunSet set = read_recordings(options.damaged, [&](recording::Damage damage) {
    return experiment::read_run_set(options.folder, options.without, damage);
  });
  warn_of_recordings(set.runs);
  if (options.session_per_folder) set.sessions = experiment::sessions_by_folder(set, options.folder);
  give_truth(set, options.film);
  experiment::Calibration found = experiment::calibrate(set, method, options.ml.choice());
  if (found.ml() == nullptr && options.session_per_folder)
    throw Error(fmt::format("--session-per-folder is of maximum likelihood, and this is {}: leave it out",
                            found.method()));
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
  add_method(command, options->method, {"auto", "ml", "umbmark", "extended", "least-squares", "robust"},
             "ml: maximum likelihood over whole drives of any\n"
             "kind; the others: from end poses of squares; auto:\n"
             "ml where ground truth followed every run, else\n"
             "robust");
  add_output(command, options->output);
  add_ml(command, options->ml);
  command.add_option("--without", options->without, "a recording to leave out, by its name (repeatable)")
      .one_each_time();
  add_damaged_flag(command, options->damaged);
  add_session_flag(command, options->session_per_folder);
  add_film_truth(command, options->film);
  command.footer(
      "ml finds c_R, c_L and b themselves, from runs of one phase or of several. The\n"
      "other methods find how they differ from the loaded ones, from the\n"
      "squares of one phase.\n"
      "Examples:\n"
      "  astrolabe calibrate runs my-experiment/before --out calib.toml\n"
      "  astrolabe calibrate runs my-experiment --without before/square-cw-3\n"
      "  astrolabe calibrate runs my-experiment/before --method umbmark --angles average --json\n"
      "  astrolabe calibrate runs drives --truth film:drives.mp4 --tag-side 120.1mm --tag-height 121mm \\\n"
      "    --floor-tag-side 160mm --tape 1:4=3.46 --out calib.toml");
  command.callback([options] { put_out(calibrate_runs(*options), options->output); });
}

}  // namespace astro::commands
