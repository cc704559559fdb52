#include "host/experiment/drive/experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <span>

#include "host/base/error.hpp"
#include "host/base/folder_lock.hpp"
#include "host/base/utc.hpp"
#include "host/experiment/analysis/trajectories.hpp"
#include "host/experiment/analysis/until.hpp"
#include "host/experiment/drive/entered_truth.hpp"
#include "host/experiment/drive/open_journal.hpp"
#include "host/experiment/drive/phase_recordings.hpp"
#include "host/experiment/files/experiment_folder.hpp"
#include "host/experiment/files/robot_identity.hpp"
#include "host/recording/run_file.hpp"
#include "host/robot/parameters/upload.hpp"

namespace astro::experiment {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr auto kReconnectPatience = 10s;
constexpr double kOnMark_m = 0.01;  // how far a robot on its start mark may be from it by odometry

std::string in_words(const calibration::WheelFactors& factors) {
  const std::string e =
      factors.e == 0 ? "" : fmt::format(", e {:.9f}, kappa0 {:.6g}", factors.e, factors.kappa0);
  return fmt::format("c_R {:.9f}, c_L {:.9f}, b {:.9f} m{}", factors.c_r, factors.c_l, factors.b_m, e);
}

RunSet without_truth(const fs::path& folder, const std::vector<RunSpec>& specs, const std::string& source) {
  RunSet set;
  for (const RunSpec& spec : specs) {
    recording::Run run = recording::read_run(file_of(folder, spec));
    if (run.info.truth_source != source || !run.truth.empty()) continue;
    set.names.push_back(
        file_of(folder, spec).lexically_relative(folder).replace_extension().generic_string());
    set.runs.push_back(std::move(run));
  }
  return set;
}

/// Completes the recordings of a phase whose truth comes after all of them (truth::LaterSource). Calls `give` with the runs
/// that have no truth, until none is left, and saves each run that got its truth at once. False if nothing was missing.
bool complete_later(const fs::path& folder, const std::vector<RunSpec>& specs, const std::string& source,
                    const std::vector<std::string>& others, const GiveTruth& give) {
  RunSet set = without_truth(folder, specs, source);
  if (set.runs.empty()) return false;
  while (!set.runs.empty()) {
    give(specs.front().phase, set, others);
    for (std::size_t i = 0; i < set.runs.size(); ++i) {
      if (set.runs[i].truth.empty()) continue;
      fs::path file = folder / set.names[i];
      recording::write_run(file += ".mcap", set.runs[i]);
    }
    set = without_truth(folder, specs, source);
  }
  return true;
}

class Session {
 public:
  Session(robot::Client& client, truth::Source& truth, const Plan& plan, fs::path folder,
          const ExperimentHooks& hooks)
      : client_(client),
        truth_(truth),
        folder_(std::move(folder)),
        lock_(folder_),
        hooks_(hooks),
        journal_(open_journal(folder_, plan, client)),
        current_(folder_),
        entered_(truth_, folder_, hooks_, journal_, current_) {}

  Results run() {
    const std::vector<std::string> phases = phase_names(journal_.plan);
    for (std::size_t i = 0; i < phases.size(); ++i) {
      current_.start();
      drive_phase(i);
      take_later_truth(i);
      read_phase(i);
      if (i + 1 < phases.size() && !calibrate(i)) break;
    }
    return results_of(read_journal(folder_), finished_, found_);
  }

 private:
  void drive_phase(std::size_t phase) {
    const Plan& plan = journal_.plan;
    announced_ = false;
    if (open_ended(plan, phase)) drive_until_enough(phase, *plan.until);
    const std::vector<RunSpec> specs = runs_of_phase(plan, phase, squares_in_phase(folder_, plan, phase));
    if (!is_over(journal_, phase)) entered_.look_back(specs);
    drive_missing(specs);
  }

  void drive_until_enough(std::size_t phase, const Until& until) {
    const Plan& plan = journal_.plan;
    if (is_over(journal_, phase)) return;  // an earlier session reached the precision
    for (int squares = squares_in_phase(folder_, plan, phase);; ++squares) {
      const std::vector<RunSpec> specs = squares_of_phase(plan, phase, squares);
      drive_missing(specs);
      const Calibration found = calibrate_with(specs);
      if (!found.absolute())
        throw Error(
            "a precision can only be driven for with ground truth along the way, and these runs have none",
            ExperimentProblem::precision_unknown);
      const calibration::Precision reached = precision_of(found);
      const std::string& name = specs.front().phase;
      const std::string each = std::to_string(squares);
      hooks_.run.notice({fmt::format("{}: {} + {} squares give {}", name, each, each, described(reached)),
                         PrecisionNotice::reached_by_now,
                         {name, each, described(reached)}});
      if (reaches(reached, until.target)) return;
      if (squares >= until.most) {
        const std::string asked = fmt::format("{:.3g}", 100 * until.target);
        hooks_.run.notice({fmt::format("{}: that is not the {} % asked for, but {} squares in each "
                                       "direction are the most: going on with it",
                                       name, asked, until.most),
                           PrecisionNotice::most_squares,
                           {name, each, asked}});
        return;
      }
    }
  }

  void drive_missing(const std::vector<RunSpec>& specs) {
    if (recorded(specs) == specs.size()) return;
    const robot::RemoteParameters parameters = robot::RemoteParameters::fetch(client_);
    if (finds_e(specs.front().phase)) require_e(parameters.rows());
    begin_phase(specs.front().phase, loaded_factors(parameters));
    announce(specs);
    std::optional<RunSpec> last;
    while (const RunSpec* spec = first_missing(folder_, specs)) {
      // Somebody took away a recording that was read already, for example to have it driven again.
      if (static_cast<std::size_t>(spec - specs.data()) < current_.size()) current_.start();
      if (drive_one(*spec, static_cast<int>(recorded(specs)) + 1, static_cast<int>(specs.size()), last,
                    parameters))
        entered_.look_back(specs);
    }
  }

  /// Whether after this phase an e is found, by what is known before it is driven.
  bool finds_e(const std::string& phase) const {
    using Family = MethodChoice::Family;
    if (phase == phase_names(journal_.plan).back()) return false;
    recording::RunInfo info;
    info.truth_source = truth_.name();
    info.truth_clock = truth_.clock();
    const Family family = journal_.plan.method.family;
    return family == Family::ml || family == Family::scans ||
           (family == Family::automatic && has_moving_truth(info));
  }

  std::size_t recorded(const std::vector<RunSpec>& specs) const {
    return static_cast<std::size_t>(std::ranges::count_if(
        specs, [&](const RunSpec& spec) { return fs::exists(file_of(folder_, spec)); }));
  }

  void announce(const std::vector<RunSpec>& specs) {
    if (const std::size_t done = recorded(specs); done > 0 && !announced_)
      hooks_.run.notice(
          {fmt::format("{}: {} of {} runs are recorded already", specs.front().phase, done, specs.size())});
    announced_ = true;
  }

  /// Drives a run, or resumes a drive that waits for its truth, and records it; or corrects the last run first, if the
  /// person wants that. False if the person wants this run driven again, so that nothing was recorded.
  bool drive_one(const RunSpec& spec, int number, int total, std::optional<RunSpec>& last,
                 const robot::RemoteParameters& parameters) {
    recording::Run run;
    if (const fs::path driven = file_without_truth(folder_, spec); fs::exists(driven)) {
      hooks_.run.notice(
          {spec.title() + " is driven, but its ground truth is missing" + to_drive_again(driven)});
      run = recording::read_run(driven);
    } else {
      // The last run has no recording any more if a person wants it driven again.
      if (last && !fs::exists(file_of(folder_, *last))) last.reset();
      if (const Redo redo = hooks_.ready(spec, last); redo != Redo::no && last) {
        entered_.correct(*last, redo);
        return true;
      }
      hooks_.run_started(spec, number, total);
      run = drive(spec, parameters);
    }
    if (!entered_.keep(spec, run)) return false;
    require_usable(folder_, journal_, spec, run);
    hooks_.run_finished(spec, run);
    if (truth_.comes_afterwards()) last = spec;
    return true;
  }

  /// Checks that a phase is driven with one set of parameters, also if it is resumed.
  void begin_phase(const std::string& phase, const calibration::WheelFactors& factors) {
    const auto known = journal_.loaded.find(phase);
    if (known != journal_.loaded.end()) {
      if (!same_factors(known->second, factors))
        throw Error(fmt::format("the robot holds {}, but phase '{}' of this experiment began with {}",
                                in_words(factors), phase, in_words(known->second)),
                    ExperimentProblem::other_factors_loaded,
                    {phase, in_words(factors), in_words(known->second)});
      return;
    }
    journal_.loaded[phase] = factors;
    write_journal(folder_, journal_);
  }

  recording::Run drive(const RunSpec& spec, const robot::RemoteParameters& parameters) {
    recording::RunInfo info = info_of(journal_.plan, spec);
    info.robot_name = journal_.robot_name;
    info.robot_id = journal_.robot_id;
    info.board = journal_.board;
    info.firmware = journal_.firmware;
    info.parameters = parameters.numbers();
    const robot::Path path = path_of(journal_.plan, spec);
    const Remark broken_off{spec.title() + " was broken off, and the robot stands on its way",
                            ExperimentProblem::broken_off,
                            {folder_.string(), spec.title()}};
    bool on_its_way = false;  // the robot has left its start mark
    RunHooks hooks = hooks_.run;
    hooks.moved = [&](const recording::OdometrySample& sample) {
      on_its_way = on_its_way || std::hypot(sample.x_m, sample.y_m) > kOnMark_m;
      hooks_.run.moved(sample);
    };
    while (true) {
      info.started_at = utc_now();
      on_its_way = false;
      try {
        return record_run(client_, truth_, path, info, hooks);
      } catch (const Interrupted&) {
        if (on_its_way) hooks_.run.notice(broken_off);
        throw;
      } catch (const robot::LinkLost& lost) {
        if (hooks_.run.interrupted()) throw;
        hooks_.run.notice(lost.remark());
        if (!hooks_.put_back(spec)) throw Error(broken_off);
        client_.reconnect(kReconnectPatience);
      } catch (const Error&) {
        if (on_its_way && !hooks_.run.interrupted()) hooks_.run.notice(broken_off);
        throw;
      }
    }
  }

  Calibration calibrate_with(const std::vector<RunSpec>& current) {
    current_.read(current);
    std::vector<std::shared_ptr<const Recordings>> phases = finished_;
    phases.push_back(current_.recordings());
    return calibrate_after(phases, journal_.plan.method);
  }

  void take_later_truth(std::size_t phase) {
    const Plan& plan = journal_.plan;
    if (plan.truth != "film") return;
    const std::vector<RunSpec> specs = runs_of_phase(plan, phase, squares_in_phase(folder_, plan, phase));
    std::vector<std::string> others;
    for (const auto& recordings : finished_)
      for (const recording::Run& run : recordings->runs()) others.push_back(run.info.truth_film);
    if (complete_later(folder_, specs, plan.truth, others, hooks_.give_truth)) current_.start();
  }

  void read_phase(std::size_t phase) {
    const Plan& plan = journal_.plan;
    current_.read(runs_of_phase(plan, phase, squares_in_phase(folder_, plan, phase)));
    finished_.push_back(current_.recordings());
    results_of(journal_, finished_,
               found_);  // what the report cannot use is an error now, before the next phase
  }

  /// False if the experiment ends here, because the robot keeps its factors.
  bool calibrate(std::size_t phase) {
    const std::vector<std::string> names = phase_names(journal_.plan);
    const Calibration found = calibrate_after(finished_, journal_.plan.method);
    const fs::path file = folder_ / fmt::format("calib-{}.toml", names[phase]);
    write_calibration(file, found);
    found_.push_back(found);
    return journal_.loaded.contains(names[phase + 1]) || upload(found, file, folder_ / names[phase]);
  }

  /// False if it is decided that the robot keeps its factors. `runs`: the folder of the phase that was driven last.
  bool upload(const Calibration& found, const fs::path& file, const fs::path& runs) {
    ParameterFile calibration = read_parameter_file(file);
    const robot::RemoteParameters robot = robot::RemoteParameters::fetch(client_);
    calibration.parameters = understood_by(robot.rows(), calibration.parameters);
    const std::vector<Change> list = changes(robot, calibration.parameters);
    if (list.empty()) return true;  // an earlier session uploaded them already
    hooks_.calibrated(found, list);
    const Remark kept{"the robot keeps what it carries; the calibration is in '" + file.string() + "'",
                      ExperimentProblem::parameters_kept,
                      {runs.string(), file.string()}};
    for (const Remark& why : objections(robot, identity_of(client_.robot()), calibration, list)) {
      hooks_.run.notice(hooks_.force ? Remark{"overridden: " + why.sentence} : kept);
      if (!hooks_.force) throw Error(why);
    }
    const Decision decision = hooks_.decide(found, list);
    if (decision == Decision::later)
      throw Error("the new parameters were not uploaded", ExperimentProblem::not_uploaded,
                  {folder_.string()});
    if (decision == Decision::keep) {
      hooks_.run.notice(kept);
      return false;
    }
    const robot::UploadReport report = robot::upload(client_, calibration.parameters);
    if (report.active != robot::ActiveSet::new_set) throw Error(report.remark());
    hooks_.uploaded(report.remark());
    return true;
  }

  robot::Client& client_;
  truth::Source& truth_;
  fs::path folder_;
  FolderLock lock_;  // two sessions would record and calibrate each other's runs
  const ExperimentHooks& hooks_;
  Journal journal_;
  std::vector<std::shared_ptr<const Recordings>> finished_;  // phases that are driven
  std::vector<Calibration> found_;                           // after each of them but the last
  PhaseRecordings current_;                                  // of the phase under way
  EnteredTruth entered_;
  bool announced_ = false;  // whether the number of recorded runs of this phase was announced
};

}  // namespace

Results run_experiment(robot::Client& client, truth::Source& truth, const Plan& plan, const fs::path& folder,
                       const ExperimentHooks& hooks) {
  plan.check();
  return Session(client, truth, plan, folder, hooks).run();
}

}  // namespace astro::experiment
