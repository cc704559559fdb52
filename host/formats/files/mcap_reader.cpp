#include "host/formats/files/mcap_reader.hpp"

#include <algorithm>

#include "host/formats/files/compression.hpp"

namespace astro::bag {
namespace {

using bag::mcap::Op;

constexpr std::size_t kMaxWarnings = 8;
constexpr std::size_t kMagicBytes = sizeof bag::mcap::kMagic;

struct Record {
  std::uint8_t op = 0;
  std::uint64_t start = 0;  // position in the file
  ByteView content;  // empty for records that no reader of ours needs: indexes, attachments, unknown ones
  bool is_too_large = false;  // needed, but larger than may be held; the content is empty
};

/// Walks over the records of a file and computes the checksum of all that it has passed. It holds one record in memory at a
/// time. Records that nobody needs are never held as a whole.
class RecordStream {
 public:
  /// Precondition: the file has at least kMagicBytes. `most_bytes`: of a record that is held.
  RecordStream(ByteSource& file, std::uint64_t most_bytes);

  /// False if there is no whole record any more; `record.start` says where. Opcode 0 also counts as the end: the format has
  /// no such record, but a file system leaves zeros where a power cut prevented the writing of bytes.
  bool next(Record& record);

  std::uint64_t at() const { return at_; }                         // of the next record
  std::uint32_t crc_before_record() const { return crc_before_; }  // of all bytes before the last record

  /// The checksum of a range of the file, continuing `before`.
  std::uint32_t crc_of(std::uint64_t from, std::uint64_t end, std::uint32_t before = 0);

 private:
  ByteSource& file_;
  std::uint64_t most_bytes_, at_ = 0;
  std::uint32_t crc_ = 0, crc_before_ = 0;
};

bool is_needed(Op op) {
  switch (op) {
    case Op::header:
    case Op::footer:
    case Op::schema:
    case Op::channel:
    case Op::message:
    case Op::chunk:
    case Op::metadata:
    case Op::data_end:
      return true;
    default:
      return false;
  }
}

RecordStream::RecordStream(ByteSource& file, std::uint64_t most_bytes)
    : file_(file), most_bytes_(most_bytes), at_(kMagicBytes), crc_(crc32_ieee(file.read(0, kMagicBytes))) {}

bool RecordStream::next(Record& record) {
  record.start = at_;
  if (file_.size() - at_ < bag::mcap::kRecordHeadBytes) return false;
  ByteCursor head(file_.read(at_, bag::mcap::kRecordHeadBytes));
  record.op = head.number<std::uint8_t>();
  const auto length = head.number<std::uint64_t>();
  if (record.op == 0 || length > file_.size() - at_ - bag::mcap::kRecordHeadBytes) return false;
  const std::uint64_t end = at_ + bag::mcap::kRecordHeadBytes + length;
  record.content = {};
  const bool is_held = is_needed(static_cast<Op>(record.op));
  record.is_too_large = is_held && length > most_bytes_;
  crc_before_ = crc_;
  if (is_held && !record.is_too_large) {
    const ByteView whole = file_.read(at_, static_cast<std::size_t>(end - at_));
    crc_ = crc32_ieee(whole, crc_);
    record.content = whole.subspan(bag::mcap::kRecordHeadBytes);
  } else {
    crc_ = crc_of(at_, end, crc_);
  }
  at_ = end;
  return true;
}

std::uint32_t RecordStream::crc_of(std::uint64_t from, std::uint64_t end, std::uint32_t before) {
  constexpr std::uint64_t kPieceBytes = std::uint64_t{1} << 20;
  while (from < end) {
    const auto count = static_cast<std::size_t>(std::min(end - from, kPieceBytes));
    before = crc32_ieee(file_.read(from, count), before);
    from += count;
  }
  return before;
}

/// The next record inside an expanded chunk; its start is not set. False as for RecordStream.
bool next_inside(ByteCursor& cursor, Record& record) {
  record.op = cursor.number<std::uint8_t>();
  record.content = cursor.take(cursor.number<std::uint64_t>());
  return cursor.ok() && record.op != 0;
}

bool is_magic(ByteView bytes) { return std::ranges::equal(bytes, bag::mcap::kMagic); }

class Walker {
 public:
  Walker(ByteSource& file, const McapHandlers& handlers, const McapLimits& limits)
      : file_(file),
        handlers_(handlers),
        limits_(limits),
        file_bytes_(limits.packed_bytes.value_or(file.size())),
        records_(file, most_bytes()) {}

  /// Precondition: the file begins like one.
  McapReport walk() {
    report_.is_mcap = true;
    while (!footer_seen_) {
      Record record;
      if (!records_.next(record)) {
        no_footer(record.start);
        return report_;
      }
      take(record);
    }
    check_end();
    return report_;
  }

 private:
  std::uint64_t most_bytes() const { return std::max(limits_.chunk_bytes, file_bytes_); }

  void warn(Remark what) {
    if (report_.warnings.size() < kMaxWarnings) report_.warnings.push_back(std::move(what));
  }
  void cut_off(const std::string& what) {
    report_.truncated = true;
    warn({what, McapProblem::cut_off, {std::to_string(file_.size())}});
  }
  void damage(McapProblem problem, const std::string& what, std::uint64_t at) {
    report_.damaged = true;
    warn({what + " at byte " + std::to_string(at), problem, {std::to_string(at)}});
  }
  /// A record that cannot be decoded; `what`: "schema".
  void bad_record(const std::string& what, std::uint64_t at) {
    report_.damaged = true;
    warn({"bad " + what + " at byte " + std::to_string(at),
          McapProblem::bad_record,
          {std::to_string(at), what}});
  }

  /// A file with an intact end was not cut off: something before it is wrong, such as a length.
  void no_footer(std::uint64_t at) {
    if (file_.size() >= 2 * kMagicBytes && is_magic(file_.read(file_.size() - kMagicBytes, kMagicBytes)))
      return damage(McapProblem::record_beyond_end, "a record that does not fit into the file", at);
    cut_off("the file ends at byte " + std::to_string(file_.size()) + " without a footer");
  }

  void take(const Record& record) {
    if (record.is_too_large)
      return damage(McapProblem::record_too_large, "a record of more bytes than this reader takes",
                    record.start);
    switch (static_cast<Op>(record.op)) {
      case Op::header:
        return header(record);
      case Op::chunk:
        return chunk(record);
      case Op::metadata:
        return metadata(record);
      case Op::data_end:
        return data_end(record);
      case Op::footer:
        return footer(record);
      default:
        return take_content(record, record.start);
    }
  }

  /// The records that may be inside or outside of chunks. `at` is the position in the file for messages.
  void take_content(const Record& record, std::uint64_t at) {
    switch (static_cast<Op>(record.op)) {
      case Op::schema:
        return schema(record, at);
      case Op::channel:
        return channel(record, at);
      case Op::message:
        return message(record, at);
      default:
        return;  // indexes, attachments, and records of later versions
    }
  }

  void header(const Record& record) {
    const auto header = bag::mcap::decode_header(record.content);
    if (!header) return bad_record("header", record.start);
    report_.profile = header->profile;
    report_.library = header->library;
  }

  void schema(const Record& record, std::uint64_t at) {
    auto schema = bag::mcap::decode_schema(record.content);
    if (!schema) return bad_record("schema", at);
    keep(schemas_, std::move(*schema), at);
  }

  void channel(const Record& record, std::uint64_t at) {
    auto channel = bag::mcap::decode_channel(record.content);
    if (!channel) return bad_record("channel", at);
    keep(channels_, std::move(*channel), at);
  }

  static std::uint64_t memory_of(const bag::mcap::Schema& schema) {
    return sizeof schema + schema.name.size() + schema.encoding.size() + schema.text.size();
  }
  static std::uint64_t memory_of(const bag::mcap::Channel& channel) {
    std::uint64_t bytes = sizeof channel + channel.topic.size() + channel.message_encoding.size();
    for (const auto& [key, value] : channel.metadata)
      bytes += sizeof(bag::mcap::Map::value_type) + key.size() + value.size();
    return bytes;
  }

  /// A definition may be repeated, even in each chunk, and replaces the one before.
  template <class Definition>
  void keep(std::map<std::uint16_t, Definition>& all, Definition&& definition, std::uint64_t at) {
    const auto before = all.find(definition.id);
    const std::uint64_t freed = before == all.end() ? 0 : memory_of(before->second);
    const std::uint64_t bytes = definition_bytes_ - freed + memory_of(definition);
    if (bytes > limits_.definition_bytes + file_bytes_)
      return damage(McapProblem::too_many_definitions, "more schemas and channels than this reader takes,",
                    at);
    definition_bytes_ = bytes;
    all.insert_or_assign(definition.id, std::move(definition));
  }

  void message(const Record& record, std::uint64_t at) {
    if (!handlers_.message) return;
    const auto message = bag::mcap::decode_message(record.content);
    if (!message) return bad_record("message", at);
    const auto channel = channels_.find(message->channel_id);
    if (channel == channels_.end())
      return damage(McapProblem::unknown_channel, "message of an unknown channel", at);
    const auto schema = schemas_.find(channel->second.schema_id);
    handlers_.message(channel->second, schema == schemas_.end() ? nullptr : &schema->second, *message);
  }

  void metadata(const Record& record) {
    const auto metadata = bag::mcap::decode_metadata(record.content);
    if (!metadata) return bad_record("metadata", record.start);
    if (handlers_.metadata) handlers_.metadata(*metadata);
  }

  void chunk(const Record& record) {
    const auto chunk = bag::mcap::decode_chunk(record.content);
    if (!chunk) return bad_record("chunk", record.start);
    if (!handlers_.message) return;
    if (chunk->size > most_bytes()) {
      return damage(McapProblem::chunk_too_large,
                    "chunk of " + std::to_string(chunk->size) + " bytes, more than this reader takes,",
                    record.start);
    }
    expanded_bytes_ += chunk->size;
    if (expanded_bytes_ > limits_.all_chunks_bytes + limits_.most_gain * file_bytes_)
      return damage(
          McapProblem::chunks_expand_too_far,
          "chunks that expand to more than " + std::to_string(limits_.most_gain) + " times the file,",
          record.start);
    const auto bytes = expand(chunk->compression, chunk->records, chunk->size);
    if (!bytes) return damage(McapProblem::chunk_does_not_expand, "chunk that does not expand", record.start);
    if (chunk->crc != 0 && chunk->crc != crc32_ieee(*bytes)) {
      return damage(McapProblem::wrong_chunk_checksum, "chunk with a wrong checksum", record.start);
    }
    ByteCursor cursor(*bytes);
    while (cursor.left() > 0) {
      Record inner;
      if (!next_inside(cursor, inner))
        return damage(McapProblem::chunk_ends_inside_record, "chunk that ends inside a record", record.start);
      take_content(inner, record.start);
    }
  }

  void data_end(const Record& record) {
    data_end_seen_ = true;
    ByteCursor cursor(record.content);
    const auto crc = cursor.number<std::uint32_t>();
    if (!cursor.ok()) return bad_record("end of data", record.start);
    if (crc != 0 && crc != records_.crc_before_record()) {
      damage(McapProblem::wrong_data_checksum, "the data have a wrong checksum: found", record.start);
    }
  }

  void footer(const Record& record) {
    footer_seen_ = true;
    const auto footer = bag::mcap::decode_footer(record.content);
    if (!footer || footer->summary_start > record.start) return bad_record("footer", record.start);
    if (footer->summary_crc == 0) return;
    constexpr std::size_t kCovered = bag::mcap::kRecordHeadBytes + 2 * sizeof(std::uint64_t);
    const std::uint64_t start = footer->summary_start == 0 ? record.start : footer->summary_start;
    if (footer->summary_crc != records_.crc_of(start, record.start + kCovered))
      damage(McapProblem::wrong_summary_checksum, "the summary has a wrong checksum: found", record.start);
  }

  void check_end() {
    const std::uint64_t at = records_.at();
    if (!data_end_seen_) damage(McapProblem::no_data_end, "no end of data before the footer", at);
    if (file_.size() - at < kMagicBytes) return cut_off("the file ends inside its last 8 bytes");
    if (file_.size() - at > kMagicBytes || !is_magic(file_.read(at, kMagicBytes)))
      damage(McapProblem::no_end_mark, "the file does not end like an MCAP file", at);
  }

  ByteSource& file_;
  const McapHandlers& handlers_;
  const McapLimits& limits_;
  std::uint64_t file_bytes_;  // to which the limits refer
  RecordStream records_;
  McapReport report_;
  std::map<std::uint16_t, bag::mcap::Schema> schemas_;
  std::map<std::uint16_t, bag::mcap::Channel> channels_;
  std::uint64_t definition_bytes_ = 0, expanded_bytes_ = 0;
  bool data_end_seen_ = false, footer_seen_ = false;
};

}  // namespace

McapReport read_mcap(ByteSource& file, const McapHandlers& handlers, const McapLimits& limits) {
  if (file.size() < kMagicBytes || !is_magic(file.read(0, kMagicBytes))) return {};
  return Walker(file, handlers, limits).walk();
}

McapReport read_mcap(ByteView file, const McapHandlers& handlers, const McapLimits& limits) {
  MemorySource source(file);
  return read_mcap(source, handlers, limits);
}

}  // namespace astro::bag
