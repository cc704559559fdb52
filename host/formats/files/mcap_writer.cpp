#include "host/formats/files/mcap_writer.hpp"

#include <algorithm>

#include "host/formats/files/compression.hpp"

namespace astro::bag {

using bag::mcap::Op;

void McapWriter::TimeSpan::include(std::uint64_t time_ns) {
  start_ns = messages == 0 ? time_ns : std::min(start_ns, time_ns);
  end_ns = messages == 0 ? time_ns : std::max(end_ns, time_ns);
  ++messages;
}

McapWriter::McapWriter(Sink sink, const bag::mcap::Header& header, McapWriterOptions options)
    : sink_(std::move(sink)), options_(options) {
  Bytes start(std::begin(bag::mcap::kMagic), std::end(bag::mcap::kMagic));
  bag::mcap::append_record(start, Op::header, bag::mcap::encode(header));
  emit(start);
}

void McapWriter::emit(ByteView bytes) {
  sink_(bytes);
  size_ += bytes.size();
  crc_ = crc32_ieee(bytes, crc_);
}

std::uint64_t McapWriter::emit_record(Op op, ByteView content) {
  Bytes record;
  const std::uint64_t length = bag::mcap::append_record(record, op, content);
  emit(record);
  return length;
}

std::uint16_t McapWriter::add_schema(std::string_view name, std::string_view encoding,
                                     std::string_view text) {
  const auto id = static_cast<std::uint16_t>(schemas_.size() + 1);
  schemas_.push_back({id, std::string(name), std::string(encoding), std::string(text)});
  bag::mcap::append_record(open_, Op::schema, bag::mcap::encode(schemas_.back()));
  return id;
}

std::uint16_t McapWriter::add_channel(std::uint16_t schema_id, std::string_view topic,
                                      std::string_view message_encoding, const bag::mcap::Map& metadata) {
  const auto id = static_cast<std::uint16_t>(channels_.size() + 1);
  channels_.push_back({{id, schema_id, std::string(topic), std::string(message_encoding), metadata}, 0, {}});
  bag::mcap::append_record(open_, Op::channel, bag::mcap::encode(channels_.back().channel));
  return id;
}

void McapWriter::write(std::uint16_t channel_id, std::uint64_t time_ns, ByteView data) {
  ChannelState& state = channels_.at(channel_id - 1U);
  state.index.emplace_back(time_ns, open_.size());
  bag::mcap::append_message(open_, {channel_id, state.messages++, time_ns, time_ns, data});
  open_span_.include(time_ns);
  file_span_.include(time_ns);
  if (open_.size() >= options_.chunk_bytes ||
      open_span_.end_ns - open_span_.start_ns >= options_.chunk_span_ns) {
    flush();
  }
}

void McapWriter::write_metadata(const bag::mcap::Metadata& metadata) {
  Bytes index;
  append(index, size_);
  append(index, emit_record(Op::metadata, bag::mcap::encode(metadata)));
  bag::mcap::append_string(index, metadata.name);
  metadata_indexes_.push_back(std::move(index));
}

/// The MessageIndex records of the open chunk, for position `start` in the file; appends channel and position
/// of each to `offsets`.
Bytes McapWriter::take_message_indexes(std::uint64_t start, Bytes& offsets) {
  Bytes out;
  for (ChannelState& state : channels_) {
    if (state.index.empty()) continue;
    std::stable_sort(state.index.begin(), state.index.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    Bytes entries;
    for (const auto& [time_ns, offset] : state.index) {
      append(entries, time_ns);
      append(entries, offset);
    }
    state.index.clear();
    Bytes content;
    append(content, state.channel.id);
    append(content, static_cast<std::uint32_t>(entries.size()));
    append(content, entries);
    append(offsets, state.channel.id);
    append(offsets, start + out.size());
    bag::mcap::append_record(out, Op::message_index, content);
  }
  return out;
}

void McapWriter::flush() {
  if (open_.empty()) return;
  const Bytes packed = compress_zstd(open_);
  // No CRC: the frame has a checksum of its content already, which takes a tenth of the time.
  const bag::mcap::Chunk chunk{open_span_.start_ns, open_span_.end_ns, open_.size(), 0, "zstd", packed};
  const std::uint64_t chunk_start = size_;
  Bytes records;
  const std::uint64_t chunk_length = bag::mcap::append_record(records, Op::chunk, bag::mcap::encode(chunk));
  Bytes offsets;
  const Bytes indexes = take_message_indexes(chunk_start + chunk_length, offsets);
  append(records, indexes);
  emit(records);

  Bytes index;
  append(index, chunk.start_ns);
  append(index, chunk.end_ns);
  append(index, chunk_start);
  append(index, chunk_length);
  append(index, static_cast<std::uint32_t>(offsets.size()));
  append(index, offsets);
  append(index, std::uint64_t{indexes.size()});
  bag::mcap::append_string(index, chunk.compression);
  append(index, std::uint64_t{packed.size()});
  append(index, chunk.size);
  chunk_indexes_.push_back(std::move(index));
  open_.clear();
  open_span_ = {};
}

Bytes McapWriter::statistics() const {
  Bytes counts;
  for (const ChannelState& state : channels_) {
    append(counts, state.channel.id);
    append(counts, std::uint64_t{state.messages});
  }
  Bytes out;
  append(out, file_span_.messages);
  append(out, static_cast<std::uint16_t>(schemas_.size()));
  append(out, static_cast<std::uint32_t>(channels_.size()));
  append(out, std::uint32_t{0});  // attachments
  append(out, static_cast<std::uint32_t>(metadata_indexes_.size()));
  append(out, static_cast<std::uint32_t>(chunk_indexes_.size()));
  append(out, file_span_.start_ns);
  append(out, file_span_.end_ns);
  append(out, static_cast<std::uint32_t>(counts.size()));
  append(out, counts);
  return out;
}

/// The groups of the summary, for position `start` in the file; appends the SummaryOffset record of each to
/// `offsets`.
Bytes McapWriter::summary_groups(std::uint64_t start, Bytes& offsets) const {
  Bytes out;
  const auto group = [&](Op op, const std::vector<Bytes>& contents) {
    if (contents.empty()) return;
    const std::size_t begin = out.size();
    for (const Bytes& content : contents) bag::mcap::append_record(out, op, content);
    Bytes offset;
    append(offset, static_cast<std::uint8_t>(op));
    append(offset, start + begin);
    append(offset, std::uint64_t{out.size() - begin});
    bag::mcap::append_record(offsets, Op::summary_offset, offset);
  };
  std::vector<Bytes> schemas;
  std::vector<Bytes> channels;
  for (const bag::mcap::Schema& schema : schemas_) schemas.push_back(bag::mcap::encode(schema));
  for (const ChannelState& state : channels_) channels.push_back(bag::mcap::encode(state.channel));
  group(Op::schema, schemas);
  group(Op::channel, channels);
  group(Op::statistics, {statistics()});
  group(Op::chunk_index, chunk_indexes_);
  group(Op::metadata_index, metadata_indexes_);
  return out;
}

void McapWriter::close() {
  flush();
  Bytes data_end;
  append(data_end, crc_);
  emit_record(Op::data_end, data_end);

  const std::uint64_t summary_start = size_;
  Bytes offsets;
  Bytes summary = summary_groups(summary_start, offsets);
  const std::uint64_t offsets_start = summary_start + summary.size();
  append(summary, offsets);
  // The footer's checksum covers the summary and the footer up to the checksum itself, head included.
  summary.push_back(static_cast<std::uint8_t>(Op::footer));
  append(summary, std::uint64_t{20});
  append(summary, summary_start);
  append(summary, offsets_start);
  append(summary, crc32_ieee(summary));
  append(summary, ByteView(bag::mcap::kMagic));
  emit(summary);
}

}  // namespace astro::bag
