#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "common/base/little_endian.hpp"
#include "common/base/result.hpp"

/// The content of a frame: a header, then the fields of one message.
namespace astro::protocol {

inline constexpr std::size_t kHeaderSize = 3;
inline constexpr std::size_t kMaxBody = 256;

/// The host chooses `request_id`, and the reply repeats it; 0 marks an event.
struct Header {
  std::uint8_t message_id = 0;
  std::uint16_t request_id = 0;
  constexpr bool operator==(const Header&) const = default;
};

/// Request ids with this bit come from an onlooker: a program that shares the port with the program that has
/// it open. They are no sign of life of the host that drives.
inline constexpr std::uint16_t kOnlookerBit = 0x8000;
constexpr bool from_onlooker(const Header& header) { return (header.request_id & kOnlookerBit) != 0; }

enum class DecodeError : std::uint8_t {
  too_short,  // the body ends before the message does
  too_long,   // bytes are left over: the peer has another version
  wrong_id,   // the body holds another message
  bad_value,  // an unknown enumeration value or group bit, or text after a NUL
};

constexpr std::string_view name(DecodeError error) {
  constexpr std::string_view kNames[] = {"too_short", "too_long", "wrong_id", "bad_value"};
  return kNames[static_cast<std::size_t>(error)];
}

/// Reads only the header, which says what to decode. Errors: too_short.
constexpr Result<Header, DecodeError> peek(std::span<const std::uint8_t> body) {
  if (body.size() < kHeaderSize) return DecodeError::too_short;
  return Header{body[0], load_little_endian<std::uint16_t>(&body[1])};
}

}  // namespace astro::protocol
