#pragma once

#include <optional>

#include "host/live/dds/rtps_fields.hpp"

namespace astro::dds {

/// The submessages of DDSI-RTPS 2.2, 9.4.5.1.1.
enum class Kind : std::uint8_t {
  pad = 0x01,
  acknowledgement = 0x06,
  heartbeat = 0x07,
  gap = 0x08,
  info_timestamp = 0x09,
  info_source = 0x0c,
  info_reply_ip4 = 0x0d,
  info_destination = 0x0e,
  info_reply = 0x0f,
  missing_fragments = 0x12,
  heartbeat_of_fragments = 0x13,
  data = 0x15,
  data_fragment = 0x16
};

inline std::endian order_in(std::uint8_t flags) {
  return (flags & 1) != 0 ? std::endian::little : std::endian::big;
}

/// What a datagram begins with: "RTPS", version, vendor, and 12 bytes that its participant's identifiers begin with.
inline constexpr std::size_t kRtpsHeader = 20, kGuidPrefixAt = 8, kGuidPrefix = 12, kEntity = 4;
inline constexpr std::size_t kSubmessageHeader = 4;

struct Submessage {
  std::uint8_t id, flags;
  ByteView body;
  std::size_t begin, end;  // in the datagram, its header included
};

/// Nothing if there is no valid one: it would reach beyond the datagram, or the next one would begin at an impossible offset.
std::optional<Submessage> submessage_at(std::size_t begin, ByteView datagram);

/// Whether the writer of a DATA is one of the built-in endpoints by which the simple discovery protocol announces
/// participants, writers and readers.
bool is_of_discovery(ByteView writer);

/// Whether the body has the fields of its kind, with values that the standard allows. A submessage of any other kind than
/// those above is always sound.
bool is_sound(std::uint8_t id, std::uint8_t flags, ByteView body);

}  // namespace astro::dds
