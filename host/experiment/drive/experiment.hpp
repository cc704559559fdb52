#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/experiment/analysis/results.hpp"
#include "host/experiment/drive/change_guard.hpp"
#include "host/experiment/drive/doubtful_run.hpp"
#include "host/experiment/drive/record_run.hpp"
#include "host/experiment/files/plan.hpp"
#include "host/experiment/files/run_set.hpp"

namespace astro::experiment {

/// Notices of an experiment that is driven until a precision is reached. Values: the phase, the number of squares in each
/// direction, and the precision that they give or, for most_squares, the requested one in percent.
enum class PrecisionNotice { reached_by_now, most_squares };

/// What a person wants to do about a run that was driven.
enum class Redo {
  no,           // it is right
  enter_again,  // its ground truth is entered again, or read again from a file that is corrected
  drive_again,
};

/// What becomes of a calibration that was found.
enum class Decision {
  load,   // into the robot, and the experiment goes on
  keep,   // the robot keeps its factors, and the experiment ends with the phases driven so far
  later,  // undecided: the experiment asks again when it is resumed
};

/// Adds ground truth to runs; may leave some runs without. May throw to end the experiment for now.
///
/// `others`  the films of earlier phases (RunInfo::truth_film). They must not be used for these runs, although they would
///           fit, because the robot drives the same in each phase.
using GiveTruth =
    std::function<void(const std::string& phase, RunSet& set, const std::vector<std::string>& others)>;

/// Callbacks through which an experiment shows progress and asks its user.
struct ExperimentHooks {
  RunHooks run;
  std::function<void(const RunSpec&, int number, int total)> run_started = [](const RunSpec&, int, int) {};
  std::function<void(const RunSpec&, const recording::Run&)> run_finished = [](const RunSpec&,
                                                                               const recording::Run&) {};
  /// Called before each drive, when the robot has to be put back on its mark. `last`: the run before it in this session, if
  /// a person entered its ground truth. Anything but `no` is about that run.
  std::function<Redo(const RunSpec&, const std::optional<RunSpec>& last)> ready =
      [](const RunSpec&, const std::optional<RunSpec>&) { return Redo::no; };
  /// The link was lost during a run, and the robot stands somewhere on its way: true once a person has put it back on its
  /// mark, and the run may be driven again. If false, the experiment ends here.
  std::function<bool(const RunSpec&)> put_back = [](const RunSpec&) { return false; };
  /// A run whose ground truth comes from a person or a file does not fit the others; it may be an earlier one. Not called
  /// again for a run that is said to be right.
  std::function<Redo(const DoubtfulRun&)> doubt = [](const DoubtfulRun&) { return Redo::no; };
  /// Called when all runs of a phase are driven, if their truth comes for all of them together.
  GiveTruth give_truth = [](const std::string&, RunSet&, const std::vector<std::string>&) {};
  /// A calibration was found, and would change these parameters of the robot. Called before anything is decided.
  std::function<void(const Calibration&, const std::vector<Change>&)> calibrated =
      [](const Calibration&, const std::vector<Change>&) {};
  /// Whether these changes are loaded. Not called if there are objections (change_guard.hpp), unless `force` is set.
  std::function<Decision(const Calibration&, const std::vector<Change>&)> decide =
      [](const Calibration&, const std::vector<Change>&) { return Decision::load; };
  bool force = false;  // upload in spite of objections, each of which is a notice then
  std::function<void(const Remark&)> uploaded = [](const Remark&) {};
};

/// The whole experiment with one robot: squares, calibration, upload, squares again. Runs that are recorded in
/// `folder` are not driven again, so an experiment that was stopped resumes where it was.
///
/// Throws astro::Error if the folder holds another plan or another robot's experiment, if the robot's parameters are not those of
/// the phase under way or lack an e that will be found, if there are objections to the upload or it is put off; and what record_run
/// throws.
Results run_experiment(robot::Client& client, truth::Source& truth, const Plan& plan,
                       const std::filesystem::path& folder, const ExperimentHooks& hooks);

}  // namespace astro::experiment
