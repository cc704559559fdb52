#pragma once

#include <string_view>
#include <type_traits>

#include "common/protocol/messages.hpp"

namespace astro::protocol {

/// The name of an enumeration of the schema, for texts that are generated from it; "" for one that is not named here.
template <class T>
constexpr std::string_view enum_name() {
  if constexpr (std::is_same_v<T, Mode>) return "Mode";
  if constexpr (std::is_same_v<T, SegmentKind>) return "SegmentKind";
  if constexpr (std::is_same_v<T, SegmentOutcome>) return "SegmentOutcome";
  if constexpr (std::is_same_v<T, ParameterKind>) return "ParameterKind";
  if constexpr (std::is_same_v<T, ResetCause>) return "ResetCause";
  if constexpr (std::is_same_v<T, ErrorCode>) return "ErrorCode";
  if constexpr (std::is_same_v<T, Fault>) return "Fault";
  if constexpr (std::is_same_v<T, GyroState>) return "GyroState";
  return "";
}

}  // namespace astro::protocol
