#pragma once

#include <optional>
#include <string>

#include "host/recording/run.hpp"

namespace astro::recording {

/// The turns without wheels that the gyro noticed in a run, the first five of them and how many more; nothing if there are none.
/// `name`: what the run is called.
std::optional<Remark> slip_remark(const Run& run, const std::string& name);

}  // namespace astro::recording
