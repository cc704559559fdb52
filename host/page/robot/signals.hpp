#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "common/protocol/telemetry.hpp"

namespace astro::page {

/// A number of the robot's telemetry, in SI units.
struct Signal {
  std::string_view name, unit, group;
  std::uint32_t field = 0;  // the group of the telemetry that has it
  double (*value)(const protocol::Telemetry&) = nullptr;
};

/// All that can be watched.
std::span<const Signal> signals();

/// Throws astro::Error if there is no such signal.
const Signal& signal_named(std::string_view name);

}  // namespace astro::page
