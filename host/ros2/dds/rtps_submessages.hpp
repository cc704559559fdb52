#pragma once

#include "host/ros2/dds/rtps_fields.hpp"

namespace astro::ros2::dds {

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

/// Whether the body has the fields of its kind, with values that the standard allows. One of no kind above is always sound.
bool is_sound(std::uint8_t id, std::uint8_t flags, ByteView body);

}  // namespace astro::ros2::dds
