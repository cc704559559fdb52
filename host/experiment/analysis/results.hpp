#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/calibration/judgement/before_after.hpp"
#include "host/experiment/analysis/calibration.hpp"
#include "host/experiment/analysis/recordings.hpp"
#include "host/experiment/analysis/squares.hpp"
#include "host/experiment/files/journal.hpp"
#include "host/recording/run.hpp"
#include "host/recording/run_file.hpp"

/// The results of an experiment, computed from the recordings in its folder.
namespace astro::experiment {

struct PhaseResult {
  std::string name;
  std::shared_ptr<const Recordings> recordings;
  calibration::ExperimentSummary summary;
  std::optional<Calibration> calibration;  // none after the last phase

  const std::vector<recording::Run>& runs() const { return recordings->runs(); }
  const Squares& squares() const { return recordings->squares(); }
};

struct Results {
  Journal journal;
  std::vector<PhaseResult> phases;

  const PhaseResult& before() const { return phases.front(); }
  const PhaseResult& after() const { return phases.back(); }
  /// The calibration whose factors were loaded in the last phase; none if nothing was uploaded yet.
  const Calibration* last_calibration() const;
  /// The last calibration of all, loaded or not; none before there is one.
  const Calibration* latest() const {
    return after().calibration ? &*after().calibration : last_calibration();
  }
  /// The calibration after the last phase that was driven, if the robot does not carry its factors.
  const Calibration* not_loaded() const;
  /// E_max_syst before over after.
  double improvement() const { return gain().factor; }
  /// The same with its 95 % interval.
  calibration::Improvement gain() const;
  /// Whether a phase was driven with an e that is not zero.
  bool shows_e() const;
  /// The squares of all phases that were left out (squares_of): which, and why.
  std::vector<std::string> left_out() const;
  /// The sentence that a phase was driven with another robot than the first one, or "".
  std::string other_robot() const;
  /// The verdict of the report in one paragraph.
  std::string verdict() const;
};

/// Reads the complete phases. A phase that is driven until a precision is reached counts as complete from its
/// smallest number of squares on. Throws astro::Error if the first phase is not complete.
Results read_results(const std::filesystem::path& folder,
                     recording::Damage damage = recording::Damage::refused);

/// The same from phases that were read before, at least one, and the calibrations after them: after all of
/// them or all but the last.
Results results_of(Journal journal, std::span<const std::shared_ptr<const Recordings>> phases,
                   std::span<const Calibration> calibrations);

/// The same from folders of recordings that no experiment made: one phase each, named after its folder. The
/// first is the reference.
Results read_folders(const std::vector<std::filesystem::path>& folders,
                     recording::Damage damage = recording::Damage::refused);

/// The one object that `umbmark --json` prints.
nlohmann::json to_json(const Results& results);

/// Before and after as a table for people.
std::vector<std::vector<std::string>> before_after_table(const Results& results);

}  // namespace astro::experiment
