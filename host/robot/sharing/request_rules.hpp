#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "common/protocol/driving_rule.hpp"
#include "common/protocol/messages.hpp"

/// What a request means for the other programs at a port, by its message id.
namespace astro::robot::request_rules {

using namespace protocol;  // NOLINT(google-build-using-namespace): this file is all messages

template <std::size_t N>
constexpr bool is_one_of(std::uint8_t message, const std::array<std::uint8_t, N>& ids) {
  return std::find(ids.begin(), ids.end(), message) != ids.end();
}

/// Requests that let the robot come to rest. They never wait for other programs, and they are never answered
/// from memory.
constexpr bool halts(std::uint8_t message) { return stops(message) || message == Pause::kId; }
constexpr bool sets_in_motion(std::uint8_t message) {
  return is_one_of(message,
                   std::array{Arm::kId, Velocity::kId, WheelVoltage::kId, AddSegment::kId, Resume::kId});
}
/// True for a motion request that must not reach the robot any more after a later `halt`.
constexpr bool is_cancelled_by(std::uint8_t message, std::uint8_t halt) {
  return stops(halt) ? sets_in_motion(message) : halt == Pause::kId && message == Resume::kId;
}
constexpr bool opens_staging(std::uint8_t message) {
  return is_one_of(message, std::array{RevertParameters::kId, DefaultParameters::kId});
}
constexpr bool needs_staging(std::uint8_t message) {
  return is_one_of(message, std::array{StageParameter::kId, CommitParameters::kId, ApplyParameters::kId});
}
/// Requests that need one of the limited slots; asking and stopping needs none.
constexpr bool needs_slot(std::uint8_t message) {
  return sets_in_motion(message) || message == SetTelemetry::kId || opens_staging(message) ||
         needs_staging(message);
}

}  // namespace astro::robot::request_rules
