#include "host/experiment/drive/phase_recordings.hpp"

#include "host/experiment/files/experiment_folder.hpp"

namespace astro::experiment {

void PhaseRecordings::start() {
  recordings_ = std::make_shared<Recordings>();
  specs_.clear();
}

void PhaseRecordings::read(std::span<const RunSpec> specs) {
  if (specs.size() <= specs_.size()) return;
  const std::span<const RunSpec> rest = specs.subspan(specs_.size());
  recordings_->add(read_specs(folder_, {rest.begin(), rest.end()}));
  specs_.insert(specs_.end(), rest.begin(), rest.end());
}

std::vector<DoubtfulRun> PhaseRecordings::doubtful(std::span<const RunSpec> specs) {
  read(specs);
  return doubtful_runs(specs, std::span(recordings_->runs()).first(specs.size()));
}

}  // namespace astro::experiment
