#include "host/experiment/analysis/recordings.hpp"

#include "host/experiment/analysis/trajectories.hpp"

namespace astro::experiment {

const std::vector<calibration::Trajectory>& Recordings::trajectories() const {
  if (!trajectories_) trajectories_ = trajectories_of(set_);
  return *trajectories_;
}

const Squares& Recordings::squares() const {
  if (!squares_) squares_ = squares_of(set_.runs);
  return *squares_;
}

}  // namespace astro::experiment
