#include "host/formats/files/mcap_records.hpp"

#include <array>

namespace astro::bag::mcap {
namespace {

void append_map(Bytes& to, const Map& map) {
  Bytes pairs;
  for (const auto& [key, value] : map) {
    append_string(pairs, key);
    append_string(pairs, value);
  }
  append(to, static_cast<std::uint32_t>(pairs.size()));
  append(to, pairs);
}

std::string take_string(ByteCursor& cursor) {
  return std::string(as_text(cursor.take(cursor.number<std::uint32_t>())));
}

/// In memory a pair of a map takes ten times its bytes in the file; a run record has some hundred pairs.
constexpr std::size_t kMostPairs = 4096;

/// If a pair reaches past the end of the map, or there are too many pairs, the whole record is bad: `cursor`
/// is moved past its end, so that ok() is false.
Map take_map(ByteCursor& cursor) {
  ByteCursor pairs(cursor.take(cursor.number<std::uint32_t>()));
  Map map;
  while (pairs.ok() && pairs.left() > 0 && map.size() <= kMostPairs) {
    std::string key = take_string(pairs);
    map[std::move(key)] = take_string(pairs);
  }
  if (!pairs.ok() || map.size() > kMostPairs) cursor.take(std::uint64_t{cursor.left()} + 1);
  return map;
}

void append_head(Bytes& to, Op op, std::uint64_t size) {
  to.push_back(static_cast<std::uint8_t>(op));
  append(to, size);
}

template <class T>
std::optional<T> if_whole(const ByteCursor& cursor, T&& record) {
  if (!cursor.ok()) return std::nullopt;
  return std::forward<T>(record);
}

}  // namespace

void append_string(Bytes& to, std::string_view text) {
  append(to, static_cast<std::uint32_t>(text.size()));
  append(to, as_bytes(text));
}

void append_message(Bytes& to, const Message& message) {
  constexpr std::size_t kFieldBytes = sizeof message.channel_id + sizeof message.sequence +
                                      sizeof message.log_time_ns + sizeof message.publish_time_ns;
  std::array<std::uint8_t, kRecordHeadBytes + kFieldBytes> head{static_cast<std::uint8_t>(Op::message)};
  store(head, 1, std::uint64_t{kFieldBytes + message.data.size()});
  store(head, kRecordHeadBytes, message.channel_id);
  store(head, kRecordHeadBytes + 2, message.sequence);
  store(head, kRecordHeadBytes + 6, message.log_time_ns);
  store(head, kRecordHeadBytes + 14, message.publish_time_ns);
  append(to, ByteView(head));
  append(to, message.data);
}

std::uint64_t append_record(Bytes& to, Op op, ByteView content) {
  append_head(to, op, content.size());
  append(to, content);
  return kRecordHeadBytes + content.size();
}

Bytes encode(const Header& header) {
  Bytes out;
  append_string(out, header.profile);
  append_string(out, header.library);
  return out;
}

Bytes encode(const Schema& schema) {
  Bytes out;
  append(out, schema.id);
  append_string(out, schema.name);
  append_string(out, schema.encoding);
  append_string(out, schema.text);
  return out;
}

Bytes encode(const Channel& channel) {
  Bytes out;
  append(out, channel.id);
  append(out, channel.schema_id);
  append_string(out, channel.topic);
  append_string(out, channel.message_encoding);
  append_map(out, channel.metadata);
  return out;
}

Bytes encode(const Metadata& metadata) {
  Bytes out;
  append_string(out, metadata.name);
  append_map(out, metadata.entries);
  return out;
}

Bytes encode(const Chunk& chunk) {
  Bytes out;
  append(out, chunk.start_ns);
  append(out, chunk.end_ns);
  append(out, chunk.size);
  append(out, chunk.crc);
  append_string(out, chunk.compression);
  append(out, std::uint64_t{chunk.records.size()});
  append(out, chunk.records);
  return out;
}

// Braced initialisers are evaluated from left to right, so the fields are read in the order of the file.
std::optional<Header> decode_header(ByteView content) {
  ByteCursor c(content);
  return if_whole(c, Header{take_string(c), take_string(c)});
}

std::optional<Schema> decode_schema(ByteView content) {
  ByteCursor c(content);
  return if_whole(c, Schema{c.number<std::uint16_t>(), take_string(c), take_string(c), take_string(c)});
}

std::optional<Channel> decode_channel(ByteView content) {
  ByteCursor c(content);
  return if_whole(c, Channel{c.number<std::uint16_t>(), c.number<std::uint16_t>(), take_string(c),
                             take_string(c), take_map(c)});
}

std::optional<Message> decode_message(ByteView content) {
  ByteCursor c(content);
  return if_whole(c, Message{c.number<std::uint16_t>(), c.number<std::uint32_t>(), c.number<std::uint64_t>(),
                             c.number<std::uint64_t>(), c.take(c.left())});
}

std::optional<Metadata> decode_metadata(ByteView content) {
  ByteCursor c(content);
  return if_whole(c, Metadata{take_string(c), take_map(c)});
}

std::optional<Chunk> decode_chunk(ByteView content) {
  ByteCursor c(content);
  return if_whole(c, Chunk{c.number<std::uint64_t>(), c.number<std::uint64_t>(), c.number<std::uint64_t>(),
                           c.number<std::uint32_t>(), take_string(c), c.take(c.number<std::uint64_t>())});
}

std::optional<Footer> decode_footer(ByteView content) {
  ByteCursor c(content);
  return if_whole(c, Footer{c.number<std::uint64_t>(), c.number<std::uint64_t>(), c.number<std::uint32_t>()});
}

}  // namespace astro::bag::mcap
