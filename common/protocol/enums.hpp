#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "common/protocol/field.hpp"

/// Enumerations on the wire: one byte each, values append only.
namespace astro::protocol {

/// What the robot is doing. In disarmed, fault and boot the bridges are open; `wheels` is open-loop voltage.
enum class Mode : std::uint8_t { disarmed, idle, velocity, segment, stopping, fault, boot, wheels, paused };
inline constexpr std::array<std::string_view, 9> kModeNames{
    "disarmed", "idle", "velocity", "segment", "stopping", "fault", "boot", "wheels", "paused"};
constexpr std::span<const std::string_view> names(Mode) { return kModeNames; }

/// The motors drive the wheels. In all other modes they brake or are off, and the robot may still roll.
constexpr bool gives_power(Mode mode) {
  return mode == Mode::velocity || mode == Mode::segment || mode == Mode::stopping || mode == Mode::wheels;
}

enum class SegmentKind : std::uint8_t { line, spin, arc, stop };
inline constexpr std::array<std::string_view, 4> kSegmentKindNames{"line", "spin", "arc", "stop"};
constexpr std::span<const std::string_view> names(SegmentKind) { return kSegmentKindNames; }

enum class SegmentOutcome : std::uint8_t { completed, aborted };
inline constexpr std::array<std::string_view, 2> kSegmentOutcomeNames{"completed", "aborted"};
constexpr std::span<const std::string_view> names(SegmentOutcome) { return kSegmentOutcomeNames; }

/// What the heading with the gyro rests on. Only in `running` does the gyro count; otherwise the heading goes on as the wheels' does.
enum class GyroState : std::uint8_t {
  off,       // the parameter gyro_axis is 0, or the board has none
  absent,    // no gyro that the board knows has answered
  starting,  // it is being set up
  learning,  // its bias is not known: the robot has not stood still for a second
  running,
  silent,     // it sends nothing new
  frozen,     // it sends the same again and again
  saturated,  // the robot turns faster than it can measure
  failed,     // it has stopped answering
};
inline constexpr std::array<std::string_view, 9> kGyroStateNames{
    "off", "absent", "starting", "learning", "running", "silent", "frozen", "saturated", "failed"};
constexpr std::span<const std::string_view> names(GyroState) { return kGyroStateNames; }

/// How a parameter's raw integer becomes a value: raw * 2^exponent, raw * 10^exponent, raw itself, 0 or 1. A
/// text has no raw value. No parameter has been a flag so far; the number stays reserved for it.
enum class ParameterKind : std::uint8_t { binary_scaled, decimal_scaled, integer, flag, text };
inline constexpr std::array<std::string_view, 5> kParameterKindNames{"binary_scaled", "decimal_scaled",
                                                                     "integer", "flag", "text"};
constexpr std::span<const std::string_view> names(ParameterKind) { return kParameterKindNames; }

/// Why the processor last started. The values are those of hal::ResetCause.
enum class ResetCause : std::uint8_t { power_on, software, watchdog, fault, pin, unknown };
inline constexpr std::array<std::string_view, 6> kResetCauseNames{"power_on", "software", "watchdog",
                                                                  "fault",    "pin",      "unknown"};
constexpr std::span<const std::string_view> names(ResetCause) { return kResetCauseNames; }

/// Why a request was refused; a refused request has changed nothing. ErrorReply's detail is 0 unless the
/// meaning below says otherwise.
enum class ErrorCode : std::uint8_t {
  unknown_message,
  malformed,
  wrong_version,
  not_armed,
  faulted,
  queue_full,
  invalid_parameter,
  unknown_parameter,
  moving,
  flash_failed,
  out_of_range,
  unsupported,
  busy,
  staging_lost,
};
inline constexpr std::array<std::string_view, 14> kErrorCodeNames{"unknown_message",
                                                                  "malformed",
                                                                  "wrong_version",
                                                                  "not_armed",
                                                                  "faulted",
                                                                  "queue_full",
                                                                  "invalid_parameter",
                                                                  "unknown_parameter",
                                                                  "moving",
                                                                  "flash_failed",
                                                                  "out_of_range",
                                                                  "unsupported",
                                                                  "busy",
                                                                  "staging_lost"};
inline constexpr std::array<std::string_view, 14> kErrorCodeMeanings{
    "no request of this protocol version has this id",
    "the fields do not decode: wrong length, or a value outside its enumeration",
    "the host's Hello named another protocol version; detail: the robot's version",
    "the sender does not drive the robot: it must arm it, or somebody has stopped or paused the robot since",
    "a fault is latched; detail: the first fault",
    "the segment queue has no room: send it again after a SegmentDone",
    "the value or the staged set is not valid; detail: id of the offending parameter",
    "no parameter has this id or index",
    "the robot must be at rest for this",
    "flash did not read back what was written; the last committed set stays in force",
    "a value of the request lies outside what the robot can do",
    "this board cannot do it",
    "the robot is still starting, or an earlier request is still under way",
    "another program has begun to change parameters meanwhile; nothing was changed",
};
constexpr std::span<const std::string_view> names(ErrorCode) { return kErrorCodeNames; }

/// The meaning in words.
constexpr std::string_view meaning(ErrorCode code) {
  return known(code) ? kErrorCodeMeanings[static_cast<std::size_t>(code)]
                     : "an error of another protocol version";
}
static_assert(known(ErrorCode::staging_lost) && !known(ErrorCode{kErrorCodeNames.size()}));

}  // namespace astro::protocol
