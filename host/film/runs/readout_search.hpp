#pragma once

#include <functional>
#include <optional>

#include "host/experiment/files/run_set.hpp"

namespace astro::film {

struct Readout {
  double seconds = 0;
  double sigma_s = 0;
};

/// The readout time, between -40 and 40 ms, that gives the odometry the greatest likelihood. `with` returns
/// the runs with their truth for a given readout time. Nothing if the likelihood hardly depends on it.
///
/// Errors  those of trajectories_of and calibration::estimate_ml.
std::optional<Readout> find_readout(const std::function<experiment::RunSet(double readout_s)>& with,
                                    double usual_s);

}  // namespace astro::film
