#pragma once

#include <functional>
#include <optional>

#include "host/experiment/files/run_set.hpp"

namespace astro::film {

struct Readout {
  double seconds = 0;
  double sigma_s = 0;
};

/// The readout with which the wheels are most likely, between -40 and 40 ms. `with`: the runs with the truth for a readout.
/// Nothing if the runs hardly show it.
///
/// Errors  those of trajectories_of and calibration::estimate_ml.
std::optional<Readout> find_readout(const std::function<experiment::RunSet(double readout_s)>& with,
                                    double usual_s);

}  // namespace astro::film
