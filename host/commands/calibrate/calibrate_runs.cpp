#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "host/base/error.hpp"
#include "host/calibration/judgement/remarks.hpp"
#include "host/calibration/likelihood/likelihood_problem.hpp"
#include "host/calibration/preparation/preparation_problem.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/calibrate/calibration_output.hpp"
#include "host/commands/calibrate/commands.hpp"
#include "host/commands/calibrate/ml_option.hpp"
#include "host/commands/calibrate/scan_truth.hpp"
#include "host/commands/shared/damaged_option.hpp"
#include "host/commands/shared/film_truth.hpp"
#include "host/commands/shared/import_options.hpp"
#include "host/commands/shared/method_option.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/experiment/analysis/analysis_problem.hpp"
#include "host/experiment/analysis/calibration.hpp"
#include "host/experiment/analysis/scanned_runs.hpp"
#include "host/experiment/files/folder_sessions.hpp"
#include "host/experiment/files/run_set.hpp"
#include "host/experiment/files/run_set_problem.hpp"
#include "host/lidar/surface.hpp"

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
  ScaleOptions scales;
  bool damaged = false, session_per_folder = false, mirrored = false;
};

void mirror_scans(experiment::RunSet& set) {
  for (recording::Run& run : set.runs) {
    if (run.scans.empty())
      throw console::WrongUsage("--truth-mirrored is of scans, and not all runs have scans");
    for (lidar::Scan& scan : run.scans) scan = lidar::mirrored(std::move(scan));
    experiment::give_truth_by_scans(run);
  }
}

void set_range_scale(experiment::RunSet& set, const ScaleOptions& scales) {
  for (recording::Run& run : set.runs) {
    if (run.scans.empty())
      throw console::WrongUsage("--range-scale-error is of scans, and not all runs have scans");
    run.info.truth_scale_sigma = scales.range_sigma();
  }
}

void calibrate_runs(const RunsOptions& options) {
  const experiment::MethodChoice method = options.method.choice();
  experiment::RunSet set = read_recordings(options.damaged, [&](recording::Damage damage) {
    return experiment::read_run_set(options.folder, options.without, damage);
  });
  warn_of_recordings(set.runs);
  if (options.session_per_folder) set.sessions = experiment::sessions_by_folder(set, options.folder);
  give_truth(set, options.film);
  if (options.mirrored) mirror_scans(set);
  if (options.scales.range.count() > 0) set_range_scale(set, options.scales);
  // Scans calibrate by themselves; all other methods take the poses that follow from them.
  using Family = experiment::MethodChoice::Family;
  if (method.family == Family::ml || method.family == Family::end_poses)
    experiment::give_missing_truth_by_scans(set.runs);
  experiment::Calibration found = experiment::calibrate(set, method, options.ml.choice());
  if (found.ml() == nullptr && options.session_per_folder)
    throw Error(fmt::format("--session-per-folder is of maximum likelihood, and this is {}: leave it out",
                            found.method()));
  if (found.ml() == nullptr && options.ml.given())
    throw Error(
        fmt::format("--K, --sigma-xy, --sigma-theta and --clock are of maximum likelihood, and this "
                    "is {}: leave them out",
                    found.method()));
  if (found.scans() == nullptr && options.scales.loaded.count() > 0)
    throw Error(
        fmt::format("--loaded-scale-error is of scans, and this is {}: leave it out", found.method()));
  options.scales.weigh_loaded(found);
  put_out(found, set, options.output);
}

constexpr const char* kLeaveRunOut = ": leave it out (of a folder: 'astrolabe calibrate runs --without {0}')";

constexpr Advice kCalibrateRunsAdvice[] = {
    {calibration::JudgementProblem::too_few_squares, ": drive some with 'astrolabe umbmark'"},
    {calibration::LikelihoodProblem::wheel_turns_backwards,
     "; 'astrolabe check-wiring' finds crossed or reversed wires"},
    {calibration::LikelihoodProblem::wheelbase_unlike,
     ": give it with --wheelbase for files of other programs, or load it with 'astrolabe params set b={0}'"},
    {calibration::LikelihoodProblem::implausible_factors,
     "; 'astrolabe check-wiring' finds wrong counts of a robot"},
    {calibration::PreparationProblem::mirrored, "; 'astrolabe check-wiring' finds crossed or reversed wires"},
    {calibration::PreparationProblem::mirrored_or_clockwise,
     "; 'astrolabe check-wiring' finds crossed or reversed wires"},
    {calibration::PreparationProblem::heading_stays,
     ": export the orientation, too, or see what 'astrolabe check-wiring' finds"},
    {experiment::AnalysisProblem::no_odometry, kLeaveRunOut},
    {experiment::AnalysisProblem::times_run_backwards, kLeaveRunOut},
    {experiment::AnalysisProblem::file_lacks_parameter, kLeaveRunOut},
    {experiment::AnalysisProblem::run_without_truth,
     ": leave it out with 'astrolabe calibrate runs --without {0}', or use --method robust, extended or "
     "umbmark"},
    {experiment::AnalysisProblem::only_some_have_scans,
     "; --without leaves a run out, and --method ml takes the poses that follow from the scans for ground "
     "truth"},
    {experiment::AnalysisProblem::no_truth,
     ": drive again with 'astrolabe umbmark' or 'astrolabe record --truth SOURCE', or give a film of the "
     "drives with --truth film:FILE"},
    {experiment::RunSetProblem::same_recording, ": leave one out with --without {0}"},
    {calibration::JudgementProblem::run_stands_out,
     "; look there, and if it was an accident leave the run out (of a folder: 'astrolabe calibrate runs "
     "--without ...'); if the tracked body was mounted anew before or after it, --session-per-folder says "
     "so"},
    {calibration::JudgementProblem::run_slipped,
     "; look there, and if it was an accident leave the run out (of a folder: 'astrolabe calibrate runs "
     "--without ...')"},
    {calibration::JudgementProblem::runs_differ,
     "; if the tracked body was mounted anew between them, keep the drives of each mounting in a folder of "
     "their own, and --session-per-folder says so"},
    {calibration::JudgementProblem::given_noise_is_wrong,
     ": let the noise be estimated (without --K, --sigma-xy and --sigma-theta)"},
    {calibration::PreparationProblem::too_little_truth,
     ": record it from the rest before the drive to the rest after it, or keep two poses, one in each rest, "
     "in the truth of "
     "every drive; of squares, 'astrolabe calibrate runs --method robust' uses the ends alone"},
    {experiment::AnalysisProblem::end_poses_only,
     ": of squares, 'astrolabe calibrate runs --method robust' uses the ends alone"},
    {calibration::PreparationProblem::nothing_in_common,
     ": check that they belong to the same drive, with 'astrolabe check-wiring' that no encoder is reversed, "
     "and in files of other programs whether each row of the wheels is the travel since the row before "
     "(--per-interval), and the units of the ground truth (--truth-unit, and theta_deg or theta_rad in "
     "--truth-columns)"},
    {experiment::AnalysisProblem::clocks_run_apart,
     ": check that both files are of one drive, and that their times are seconds of a clock; if they are, "
     "--clock estimated takes the drive"},
    {calibration::PreparationProblem::clock_unsettled,
     ": record wheels and ground truth from the rest before the drive to the rest after it, or give the "
     "truth the robot's times and --clock known"},
};

}  // namespace

void add_calibrate_runs(console::Command calibrate) {
  advise(kCalibrateRunsAdvice);
  const auto options = std::make_shared<RunsOptions>();
  const console::Command command =
      calibrate.add_subcommand("runs", "from recorded runs with ground truth (MCAP)");
  command.add_option("folder", options->folder, "folder with the recordings").required();
  add_method(command, options->method,
             {"auto", "ml", "scan", "umbmark", "extended", "least-squares", "robust"},
             "ml: maximum likelihood over whole drives of any\n"
             "kind; scan: the same from scans of a laser scanner;\n"
             "the others: from end poses of squares; auto: scan\n"
             "or ml where scans or ground truth followed every\n"
             "run, else robust");
  add_output(command, options->output);
  add_report_file(command, options->output);
  add_ml(command, options->ml);
  command.add_option("--without", options->without, "a recording to leave out, by its name (repeatable)")
      .one_each_time();
  command.add_flag("--truth-mirrored", options->mirrored,
                   "scans: the laser scanner hung upside down, or its\nbeams ran the other way round");
  add_scales(command, options->scales);
  add_damaged_flag(command, options->damaged);
  add_session_flag(command, options->session_per_folder);
  add_film_truth(command, options->film);
  command.footer(
      "ml finds c_R, c_L and b themselves, from runs of one phase or of several. The\n"
      "other methods find how they differ from the loaded ones, from the\n"
      "squares of one phase.\n"
      "Examples:\n"
      "  astrolabe calibrate runs my-experiment/before --out calib.toml --report report.html\n"
      "  astrolabe calibrate runs my-experiment --without before/square-cw-3\n"
      "  astrolabe calibrate runs my-experiment/before --method umbmark --angles average --json\n"
      "  astrolabe calibrate runs drives --truth film:drives.mp4 --tag-side 120.1mm --tag-height 121mm \\\n"
      "    --floor-tag-side 160mm --tape 1:4=3.46 --out calib.toml");
  command.callback([options] { calibrate_runs(*options); });
}

}  // namespace astro::commands
