#include "host/ros2/dds/rtps_check.hpp"

#include <algorithm>

#include "host/ros2/dds/rtps_submessages.hpp"

namespace astro::ros2::dds {
namespace {

constexpr std::size_t kHeader = 20, kSubmessageHeader = 4;
constexpr std::uint8_t kVersion = 2;
constexpr std::uint8_t kFirstOfVendors = 0x80;

bool has_header(ByteView datagram) {
  return datagram.size() >= kHeader && as_text(datagram.first(4)) == "RTPS" && datagram[4] == kVersion;
}

/// A length of zero means all that follows, except for the two kinds that may be empty.
bool reaches_to_the_end(std::uint16_t length, std::uint8_t id) {
  return length == 0 && id != static_cast<std::uint8_t>(Kind::pad) &&
         id != static_cast<std::uint8_t>(Kind::info_timestamp);
}

}  // namespace

ByteView sound_part(ByteView datagram) {
  if (!has_header(datagram)) return {};
  std::size_t at = kHeader, sound = 0;
  bool of_standard = true;
  while (at < datagram.size()) {
    if (datagram.size() - at < kSubmessageHeader) return {};
    const std::uint8_t id = datagram[at], flags = datagram[at + 1];
    RtpsFields fields(datagram.subspan(at + 2), order_in(flags));
    const std::uint16_t length = fields.u16();
    const ByteView rest = fields.rest();
    const ByteView body =
        reaches_to_the_end(length, id) ? rest : rest.first(std::min<std::size_t>(length, rest.size()));
    const bool is_last = body.size() == rest.size();
    if (body.size() < length || (!is_last && length % 4 != 0)) return {};
    of_standard = of_standard && id < kFirstOfVendors;
    if (of_standard && !is_sound(id, flags, body)) return {};
    at += kSubmessageHeader + body.size();
    if (of_standard) sound = at;
  }
  return datagram.first(sound);
}

}  // namespace astro::ros2::dds
