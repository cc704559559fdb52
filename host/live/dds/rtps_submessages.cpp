#include "host/live/dds/rtps_submessages.hpp"

#include <algorithm>
#include <optional>

#include "host/live/dds/rtps_check.hpp"
#include "host/live/dds/rtps_parameters.hpp"

namespace astro::dds {
namespace {

constexpr std::size_t kCount = 4;
constexpr std::uint32_t kMostInSet = 256;

/// A length of zero means all that follows, except for the two kinds that may be empty.
bool reaches_to_the_end(std::uint16_t length, std::uint8_t id) {
  return length == 0 && id != static_cast<std::uint8_t>(Kind::pad) &&
         id != static_cast<std::uint8_t>(Kind::info_timestamp);
}

bool has(std::uint8_t flags, int bit) { return (flags >> bit & 1) != 0; }

bool is_number(std::int64_t number) { return number >= 1 && number <= kLargestNumber; }

/// Whether a fragment can have this number, since each fragment has at least one byte.
bool is_fragment(std::uint32_t number) { return number >= 1 && number <= kLargestFragmentedSample; }

/// Reads the bits of a set whose first number has been read.
bool read_bits(RtpsFields& fields) {
  const std::uint32_t bits = fields.u32();
  if (bits > kMostInSet) return false;
  fields.take(std::size_t{4} * ((bits + 31) / 32));
  return fields.ok();
}

/// Also allows a set that begins at 0, which Fast DDS sends first, although the standard begins at 1.
bool is_acknowledgement(RtpsFields fields) {
  fields.take(2 * kEntity);
  const std::int64_t first = fields.sequence_number();
  if ((first != 0 && !is_number(first)) || !read_bits(fields)) return false;
  fields.take(kCount);
  return fields.ok();
}

bool is_heartbeat(RtpsFields fields) {
  fields.take(2 * kEntity);
  const std::int64_t first = fields.sequence_number(), last = fields.sequence_number();
  fields.take(kCount);
  return fields.ok() && is_number(first) && last >= first - 1 && last <= kLargestNumber;
}

bool is_gap(RtpsFields fields) {
  fields.take(2 * kEntity);
  const std::int64_t first = fields.sequence_number();
  const std::int64_t set = fields.sequence_number();
  return is_number(first) && is_number(set) && set - first <= kLongestGap && read_bits(fields);
}

bool is_missing_fragments(RtpsFields fields) {
  fields.take(2 * kEntity);
  if (!is_number(fields.sequence_number()) || !is_fragment(fields.u32()) || !read_bits(fields)) return false;
  fields.take(kCount);
  return fields.ok();
}

bool is_heartbeat_of_fragments(RtpsFields fields) {
  fields.take(2 * kEntity);
  const bool numbered = is_number(fields.sequence_number()) && is_fragment(fields.u32());
  fields.take(kCount);
  return numbered && fields.ok();
}

void read_locators(RtpsFields& fields) {
  constexpr std::size_t kLocatorSize = 24;
  fields.take(std::size_t{fields.u32()} * kLocatorSize);
}

bool is_reply(RtpsFields fields, bool multicast) {
  read_locators(fields);
  if (multicast) read_locators(fields);
  return fields.ok();
}

/// What DATA and DATA_FRAG begin with.
struct Head {
  std::size_t inline_qos = 0;  // its offset in the body
  ByteView writer{};
};

/// The inline QoS may begin later than the fields that are known, in a newer version of the standard.
bool read_head(RtpsFields& fields, std::size_t known, Head& head) {
  fields.take(2);
  const std::uint16_t to_inline_qos = fields.u16();
  head.inline_qos = fields.offset() + to_inline_qos;
  fields.take(kEntity);
  head.writer = fields.take(kEntity);
  return is_number(fields.sequence_number()) && to_inline_qos >= known && to_inline_qos % 4 == 0;
}

/// Nothing if there is no room for it.
std::optional<ByteView> payload_in(ByteView body, std::endian order, const Head& head, bool inline_qos) {
  if (body.size() < head.inline_qos) return std::nullopt;
  const ByteView rest = body.subspan(head.inline_qos);
  if (!inline_qos) return rest;
  const auto size = parameter_list_size(rest, order);
  if (!size) return std::nullopt;
  return rest.subspan(*size);
}

bool is_data(RtpsFields fields, std::uint8_t flags, ByteView body) {
  constexpr std::size_t kKnown = 16, kRepresentation = 4;
  const bool inline_qos = has(flags, 1), data = has(flags, 2), key = has(flags, 3);
  Head head;
  if ((data && key) || !read_head(fields, kKnown, head)) return false;
  const auto payload = payload_in(body, fields.order(), head, inline_qos);
  if (!payload) return false;
  if (!data && !key) return true;
  return payload->size() >= kRepresentation &&
         (!is_of_discovery(head.writer) || is_parameter_list_payload(*payload));
}

/// Fragments are numbered from 1 and all of one size but for the last one of the sample.
bool is_data_fragment(RtpsFields fields, std::uint8_t flags, ByteView body) {
  constexpr std::size_t kKnown = 28;
  Head head;
  if (!read_head(fields, kKnown, head)) return false;
  const std::uint64_t first = fields.u32(), count = fields.u16(), size = fields.u16(), sample = fields.u32();
  const auto payload = payload_in(body, fields.order(), head, has(flags, 1));
  if (!payload || first < 1 || count < 1 || size < 1) return false;
  if (sample < size || sample > kLargestFragmentedSample || is_of_discovery(head.writer)) return false;
  const std::uint64_t begin = (first - 1) * size, end = begin + count * size;
  return begin < sample && end < sample + size && payload->size() >= std::min(end, sample) - begin;
}

}  // namespace

std::optional<Submessage> submessage_at(std::size_t begin, ByteView datagram) {
  if (datagram.size() < begin + kSubmessageHeader) return std::nullopt;
  const std::uint8_t id = datagram[begin], flags = datagram[begin + 1];
  RtpsFields fields(datagram.subspan(begin + 2), order_in(flags));
  const std::uint16_t length = fields.u16();
  const ByteView rest = fields.rest();
  const ByteView body =
      reaches_to_the_end(length, id) ? rest : rest.first(std::min<std::size_t>(length, rest.size()));
  const bool is_last = body.size() == rest.size();
  if (body.size() < length || (!is_last && length % 4 != 0)) return std::nullopt;
  return Submessage{id, flags, body, begin, begin + kSubmessageHeader + body.size()};
}

bool is_of_discovery(ByteView writer) {
  constexpr std::uint8_t kWriters[][kEntity] = {{0, 1, 0, 0xc2}, {0, 0, 3, 0xc2}, {0, 0, 4, 0xc2}};
  return std::ranges::any_of(kWriters, [&](const auto& known) { return std::ranges::equal(writer, known); });
}

bool is_sound(std::uint8_t id, std::uint8_t flags, ByteView body) {
  const RtpsFields fields(body, order_in(flags));
  switch (static_cast<Kind>(id)) {
    case Kind::acknowledgement:
      return is_acknowledgement(fields);
    case Kind::heartbeat:
      return is_heartbeat(fields);
    case Kind::gap:
      return is_gap(fields);
    case Kind::info_timestamp:
      return has(flags, 1) || body.size() >= 8;
    case Kind::info_source:
      return body.size() >= 8 + kGuidPrefix;
    case Kind::info_reply_ip4:
      return body.size() >= (has(flags, 1) ? 16U : 8U);
    case Kind::info_destination:
      return body.size() >= kGuidPrefix;
    case Kind::info_reply:
      return is_reply(fields, has(flags, 1));
    case Kind::missing_fragments:
      return is_missing_fragments(fields);
    case Kind::heartbeat_of_fragments:
      return is_heartbeat_of_fragments(fields);
    case Kind::data:
      return is_data(fields, flags, body);
    case Kind::data_fragment:
      return is_data_fragment(fields, flags, body);
    case Kind::pad:
      break;
  }
  return true;
}

}  // namespace astro::dds
