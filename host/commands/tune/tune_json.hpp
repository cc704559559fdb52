#pragma once

#include "host/commands/shared/robot_view.hpp"
#include "host/commands/tune/tune_job.hpp"

namespace astro::commands {

/// What `astrolabe tune` found, for scripts.
Json to_json(const TuneResult& result);

}  // namespace astro::commands
