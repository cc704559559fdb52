#include "host/live/dds/rtps_compatibility.hpp"

#include <algorithm>

#include "host/live/dds/rtps_submessages.hpp"

namespace astro::dds {
namespace {

constexpr std::size_t kBitmapWord = 4;
constexpr std::uint8_t kDataFlag = 0x04, kKeyFlag = 0x08;

bool is_a(const Submessage& submessage, Kind kind) {
  return submessage.id == static_cast<std::uint8_t>(kind);
}

/// Source and destination of the following submessages of a datagram; empty if they are not stated.
struct Route {
  ByteView from, to;
};

template <class Each>
void for_each_submessage(ByteView datagram, Each each) {
  if (datagram.size() < kRtpsHeader) return;
  Route route{datagram.subspan(kGuidPrefixAt, kGuidPrefix), {}};
  for (auto next = submessage_at(kRtpsHeader, datagram); next; next = submessage_at(next->end, datagram)) {
    if (is_a(*next, Kind::info_source)) route.from = next->body.subspan(8, kGuidPrefix);
    if (is_a(*next, Kind::info_destination)) route.to = next->body.first(kGuidPrefix);
    each(*next, route);
  }
}

Guid guid_of(ByteView prefix, ByteView entity) {
  Guid guid;
  std::ranges::copy(prefix, guid.bytes.begin());
  std::ranges::copy(entity, guid.bytes.begin() + kGuidPrefix);
  return guid;
}

/// The fields of an acknowledgement, and the offsets of two of them in its body.
struct Acknowledged {
  ByteView reader, writer;
  std::int64_t first = 0;
  std::size_t low_word_of_first = 0, count_at = 0;
  std::uint32_t bits = 0, count = 0;

  /// Whether the reader has found the writer and received nothing yet, as Fast DDS or CycloneDDS says it.
  bool is_first() const { return bits == 0 && (first == 0 || (first == 1 && count == 0)); }
  Acknowledgement on(const Route& route) const {
    return {guid_of(route.from, reader), guid_of(route.to, writer)};
  }
};

Acknowledged read_acknowledgement(const Submessage& submessage) {
  RtpsFields fields(submessage.body, order_in(submessage.flags));
  Acknowledged read;
  read.reader = fields.take(kEntity);
  read.writer = fields.take(kEntity);
  read.first = fields.sequence_number();
  read.low_word_of_first = fields.offset() - kBitmapWord;
  read.bits = fields.u32();
  fields.take(std::size_t{kBitmapWord} * ((read.bits + 31) / 32));
  read.count_at = fields.offset();
  read.count = fields.u32();
  return read;
}

bool names_a_key_alone(const Submessage& submessage) {
  constexpr std::size_t kWriterAt = 8;
  return is_a(submessage, Kind::data) && (submessage.flags & kKeyFlag) != 0 &&
         is_of_discovery(submessage.body.subspan(kWriterAt, kEntity));
}

void put(std::span<std::uint8_t> into, std::uint32_t word, std::endian order) {
  store(into, 0, order == std::endian::native ? word : __builtin_bswap32(word));
}

void change(const Submessage& submessage, const Route& route, AcknowledgementCounts& counts,
            std::span<std::uint8_t> datagram) {
  if (names_a_key_alone(submessage)) datagram[submessage.begin + 1] ^= kKeyFlag | kDataFlag;
  if (!is_a(submessage, Kind::acknowledgement)) return;
  const Acknowledged read = read_acknowledgement(submessage);
  const auto body = datagram.subspan(submessage.begin + kSubmessageHeader);
  const std::endian order = order_in(submessage.flags);
  if (read.is_first()) put(body.subspan(read.low_word_of_first), 0, order);
  put(body.subspan(read.count_at), counts.next(read.on(route)), order);
}

}  // namespace

std::optional<Bytes> for_fast_dds(ByteView datagram, AcknowledgementCounts& counts) {
  bool differs = false;
  for_each_submessage(datagram, [&](const Submessage& each, const Route&) {
    differs = differs || is_a(each, Kind::acknowledgement) || names_a_key_alone(each);
  });
  if (!differs) return std::nullopt;
  Bytes changed(datagram.begin(), datagram.end());
  for_each_submessage(
      datagram, [&](const Submessage& each, const Route& route) { change(each, route, counts, changed); });
  return changed;
}

std::vector<Acknowledgement> acknowledgements_in(ByteView datagram) {
  std::vector<Acknowledgement> all;
  for_each_submessage(datagram, [&](const Submessage& each, const Route& route) {
    if (!is_a(each, Kind::acknowledgement) || route.to.empty()) return;
    const Acknowledged read = read_acknowledgement(each);
    if (!read.is_first()) all.push_back(read.on(route));
  });
  return all;
}

}  // namespace astro::dds
