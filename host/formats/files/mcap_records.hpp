#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "host/base/bytes.hpp"

/// The records of MCAP that reader and writer share. A record is an opcode (u8), a length (u64) and that many
/// bytes; a string is a u32 length and UTF-8; a map is a u32 length in bytes and its pairs. Times are
/// nanoseconds.
///
/// Source  https://mcap.dev/spec, version 0.
namespace astro::bag::mcap {

inline constexpr std::uint8_t kMagic[8] = {0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
inline constexpr std::size_t kRecordHeadBytes = 9;

enum class Op : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  statistics = 0x0B,
  metadata = 0x0C,
  metadata_index = 0x0D,
  summary_offset = 0x0E,
  data_end = 0x0F,
};

using Map = std::map<std::string, std::string>;

struct Header {
  std::string profile, library;
};

struct Schema {
  std::uint16_t id = 0;
  std::string name, encoding, text;
};

struct Channel {
  std::uint16_t id = 0, schema_id = 0;
  std::string topic, message_encoding;
  Map metadata;
};

struct Message {
  std::uint16_t channel_id = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time_ns = 0, publish_time_ns = 0;
  ByteView data;
};

struct Metadata {
  std::string name;
  Map entries;
};

struct Chunk {
  std::uint64_t start_ns = 0, end_ns = 0, size = 0;
  std::uint32_t crc = 0;
  std::string compression;
  ByteView records;
};

struct Footer {
  std::uint64_t summary_start = 0, summary_offset_start = 0;
  std::uint32_t summary_crc = 0;
};

/// The contents of a record, without opcode and length.
Bytes encode(const Header& header);
Bytes encode(const Schema& schema);
Bytes encode(const Channel& channel);
Bytes encode(const Metadata& metadata);
Bytes encode(const Chunk& chunk);

/// Appends one whole record and returns its length.
std::uint64_t append_record(Bytes& to, Op op, ByteView content);
/// Appends one whole record; messages are most of a file, so theirs is made in place.
void append_message(Bytes& to, const Message& message);
void append_string(Bytes& to, std::string_view text);

/// Decode contents; nothing if a field reaches past the end. Additional fields at the end are ignored, as the
/// format requires.
std::optional<Header> decode_header(ByteView content);
std::optional<Schema> decode_schema(ByteView content);
std::optional<Channel> decode_channel(ByteView content);
std::optional<Message> decode_message(ByteView content);
std::optional<Metadata> decode_metadata(ByteView content);
std::optional<Chunk> decode_chunk(ByteView content);
std::optional<Footer> decode_footer(ByteView content);

}  // namespace astro::bag::mcap
