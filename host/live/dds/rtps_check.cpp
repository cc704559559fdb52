#include "host/live/dds/rtps_check.hpp"

#include "host/live/dds/rtps_submessages.hpp"

namespace astro::dds {
namespace {

constexpr std::uint8_t kVersion = 2;
constexpr std::uint8_t kFirstOfVendors = 0x80;

bool has_header(ByteView datagram) {
  return datagram.size() >= kRtpsHeader && as_text(datagram.first(4)) == "RTPS" && datagram[4] == kVersion;
}

}  // namespace

ByteView sound_part(ByteView datagram) {
  if (!has_header(datagram)) return {};
  std::size_t at = kRtpsHeader, sound = 0;
  bool of_standard = true;
  while (at < datagram.size()) {
    const auto submessage = submessage_at(at, datagram);
    if (!submessage) return {};
    of_standard = of_standard && submessage->id < kFirstOfVendors;
    if (of_standard && !is_sound(submessage->id, submessage->flags, submessage->body)) return {};
    at = submessage->end;
    if (of_standard) sound = at;
  }
  return datagram.first(sound);
}

}  // namespace astro::dds
