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

std::optional<MistypedSquare> PhaseRecordings::mistyped(std::span<const RunSpec> earlier, const RunSpec& spec,
                                                        const recording::Run& run, double side_m) {
  read(earlier);
  std::vector<RunEnd> ends;
  for (std::size_t i = 0; i < earlier.size(); ++i)
    ends.push_back(run_end(earlier[i], recordings_->runs()[i]));
  ends.push_back(run_end(spec, run));
  return mistyped_square(ends, side_m);
}

}  // namespace astro::experiment
