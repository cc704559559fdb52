#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/experiment/analysis/calibration.hpp"
#include "host/experiment/files/journal.hpp"
#include "host/experiment/analysis/squares.hpp"
#include "host/recording/run/run.hpp"
#include "host/recording/files/run_file.hpp"
#include "host/report/comparison.hpp"

/// What came out of an experiment, worked out from its folder alone.
namespace astro::experiment {

struct PhaseResult {
  std::string name;
  std::vector<recording::Run> runs;
  Squares squares;
  calibration::ExperimentSummary summary;
  std::optional<Calibration> calibration;  // none after the last phase
};

struct Results {
  Journal journal;
  std::vector<PhaseResult> phases;

  const PhaseResult& before() const { return phases.front(); }
  const PhaseResult& after() const { return phases.back(); }
  /// The one whose factors the last phase carried; none if nothing was uploaded yet.
  const Calibration* last_calibration() const;
  /// E_max_syst before over after.
  double improvement() const { return gain().factor; }
  /// The same with its 95 % interval.
  report::Improvement gain() const;
  /// The sentence that a phase was driven with another robot than the first one, or "".
  std::string other_robot() const;
  /// What the report says of it, for people: one paragraph.
  std::string verdict() const;
};

/// Reads the phases that are complete; one that is driven until a precision is reached is, from its fewest
/// squares on. Throws astro::Error if the first one is not.
Results read_results(const std::filesystem::path& folder,
                     recording::Damage damage = recording::Damage::refused);

/// The same from folders of recordings that no experiment made: one phase each, named after its folder. The
/// first is the reference.
Results read_folders(const std::vector<std::filesystem::path>& folders,
                     recording::Damage damage = recording::Damage::refused);

/// The one object that `umbmark --json` prints.
nlohmann::json to_json(const Results& results);

/// The table that a person reads.
std::vector<std::vector<std::string>> before_after_table(const Results& results);

}  // namespace astro::experiment
