#pragma once

#include <filesystem>
#include <functional>

#include "host/experiment/drive/change_guard.hpp"
#include "host/experiment/drive/record_run.hpp"
#include "host/experiment/analysis/results.hpp"

namespace astro::experiment {

/// What the front end of an experiment shows and is asked.
struct ExperimentHooks {
  RunHooks run;
  std::function<void(const RunSpec&, int number, int total)> run_started = [](const RunSpec&, int, int) {};
  std::function<void(const RunSpec&, const recording::Run&)> run_finished = [](const RunSpec&,
                                                                               const recording::Run&) {};
  /// Before each drive: the moment to put the robot back on its mark.
  std::function<void(const RunSpec&)> ready = [](const RunSpec&) {};
  /// True: keep the ground truth that was entered for a run although it looks mistyped, for the reason given;
  /// false: it is asked for again.
  std::function<bool(const std::string& why)> keep = [](const std::string&) { return true; };
  /// True: put these in force. Not asked where there is an objection (change_guard.hpp): that is refused.
  std::function<bool(const Calibration&, const std::vector<Change>&)> agree =
      [](const Calibration&, const std::vector<Change>&) { return true; };
  bool force = false;  // objections are not heard
  std::function<void(const std::string&)> uploaded = [](const std::string&) {};
};

/// The whole experiment against one robot: squares, calibration, upload, squares again. What is recorded in
/// `folder` already is not driven again: an experiment that was stopped goes on where it was.
///
/// Throws astro::Error if the folder holds another plan or another robot's experiment, if the robot's
/// parameters are not those of the phase under way, if the upload is not agreed to or suspicious; and what
/// record_run throws.
Results run_experiment(robot::Client& client, truth::Source& truth, const Plan& plan,
                       const std::filesystem::path& folder, const ExperimentHooks& hooks);

}  // namespace astro::experiment
