#include "host/experiment/analysis/recordings.hpp"

#include <iterator>

#include "host/experiment/analysis/trajectories.hpp"

namespace astro::experiment {

void Recordings::add(RunSet more) {
  set_.names.insert(set_.names.end(), std::make_move_iterator(more.names.begin()),
                    std::make_move_iterator(more.names.end()));
  set_.runs.insert(set_.runs.end(), std::make_move_iterator(more.runs.begin()),
                   std::make_move_iterator(more.runs.end()));
  set_.sessions.insert(set_.sessions.end(), std::make_move_iterator(more.sessions.begin()),
                       std::make_move_iterator(more.sessions.end()));
  squares_.reset();
}

const std::vector<calibration::Trajectory>& Recordings::trajectories() const {
  extend_trajectories(trajectories_, set_);
  return trajectories_;
}

const Squares& Recordings::squares() const {
  if (!squares_) squares_ = squares_of(set_.runs, set_.names);
  return *squares_;
}

}  // namespace astro::experiment
