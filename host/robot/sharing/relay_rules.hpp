#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "common/protocol/messages.hpp"

/// What a request means to the programs at a port, by its message id.
namespace astro::robot::relay_rules {

using namespace protocol;  // NOLINT(google-build-using-namespace): this file is all messages

template <std::size_t N>
constexpr bool is_one_of(std::uint8_t message, const std::array<std::uint8_t, N>& ids) {
  return std::find(ids.begin(), ids.end(), message) != ids.end();
}

/// What makes its sender the driver.
constexpr bool drives(std::uint8_t message) {
  return is_one_of(message, std::array{Arm::kId, Velocity::kId, WheelVoltage::kId, AddSegment::kId});
}
constexpr bool stops(std::uint8_t message) {
  return is_one_of(message, std::array{EmergencyStop::kId, Stop::kId, Disarm::kId});
}
/// What must not come to the robot after a Stop that came later.
constexpr bool sets_in_motion(std::uint8_t message) { return drives(message) || message == Resume::kId; }
constexpr bool opens_staging(std::uint8_t message) {
  return is_one_of(message, std::array{RevertParameters::kId, DefaultParameters::kId});
}
constexpr bool needs_staging(std::uint8_t message) {
  return is_one_of(message, std::array{StageParameter::kId, CommitParameters::kId, ApplyParameters::kId});
}
/// What a program needs a place for, of which there are so many; to look and to stop is free.
constexpr bool takes_a_place(std::uint8_t message) {
  return sets_in_motion(message) || message == SetTelemetry::kId || opens_staging(message) ||
         needs_staging(message);
}

}  // namespace astro::robot::relay_rules
