#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/experiment/drive/experiment.hpp"
#include "host/experiment/drive/phase_recordings.hpp"
#include "host/experiment/files/journal.hpp"
#include "host/truth/source/source.hpp"

namespace astro::experiment {

/// Ground truth that comes after a run, from a person or a file. Keeps the drive until its truth is there, compares that
/// with the truth of the other runs, and lets a person correct it, also in a run that was recorded earlier.
class EnteredTruth {
 public:
  /// Keeps references to all.
  EnteredTruth(truth::Source& truth, const std::filesystem::path& folder, const ExperimentHooks& hooks,
               Journal& journal, PhaseRecordings& recordings)
      : truth_(truth), folder_(folder), hooks_(hooks), journal_(journal), recordings_(recordings) {}

  /// Records a run. Saves the drive before a person is asked for its truth, because they may leave or press Ctrl-C. False
  /// if they want it driven again; then nothing is kept.
  bool keep(const RunSpec& spec, recording::Run& run);

  /// Asks about each run of a phase that does not fit the others, until all are right or one has to be driven again. The
  /// recordings stay on the disk meanwhile, and the journal keeps what a person has confirmed. Does nothing for truth from
  /// trackers.
  void look_back(const std::vector<RunSpec>& specs);

  /// Enters the truth of a recorded run again, or takes its recording away so that it is driven again.
  void correct(const RunSpec& spec, Redo redo);

 private:
  bool ask(recording::Run& run, const char* what_is_left);
  std::optional<DoubtfulRun> most_doubtful(const std::vector<RunSpec>& specs);
  std::string name_in_folder(const RunSpec& spec) const;

  truth::Source& truth_;
  const std::filesystem::path& folder_;
  const ExperimentHooks& hooks_;
  Journal& journal_;
  PhaseRecordings& recordings_;
};

}  // namespace astro::experiment
