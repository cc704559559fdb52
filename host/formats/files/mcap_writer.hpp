#pragma once

#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "host/formats/files/mcap_records.hpp"

namespace astro::bag {

/// When a chunk is closed and passed to the sink: at this size, or when its messages span this time. A
/// recorder that is killed loses only the open chunk.
struct McapWriterOptions {
  std::size_t chunk_bytes = std::size_t{1} << 20;
  std::uint64_t chunk_span_ns = 2'000'000'000;
};

/// Writes an MCAP file front to back: zstd chunks with checksums, message indexes, and at the end the summary
/// that lets viewers seek. The bytes in the sink are a readable file at any moment.
///
/// Times   nanoseconds. Messages may come in any order of time.
/// Errors  none of its own; exceptions of the sink pass through.
class McapWriter {
 public:
  using Sink = std::function<void(ByteView)>;

  McapWriter(Sink sink, const bag::mcap::Header& header, McapWriterOptions options = {});

  /// Return ids, counted from 1. ROS 2: encoding "ros2msg" for schemas, message encoding "cdr" for channels.
  std::uint16_t add_schema(std::string_view name, std::string_view encoding, std::string_view text);
  std::uint16_t add_channel(std::uint16_t schema_id, std::string_view topic,
                            std::string_view message_encoding, const bag::mcap::Map& metadata);

  void write(std::uint16_t channel_id, std::uint64_t time_ns, ByteView data);
  /// Written to the sink at once, before the open chunk.
  void write_metadata(const bag::mcap::Metadata& metadata);
  /// Closes the open chunk, if it holds anything.
  void flush();
  /// Flushes and writes the summary. Nothing may be written afterwards. Without close() the file counts as
  /// cut off.
  void close();

 private:
  struct ChannelState {
    bag::mcap::Channel channel;
    std::uint32_t messages = 0;
    std::vector<std::pair<std::uint64_t, std::uint64_t>> index;  // time, offset in the open chunk
  };
  struct TimeSpan {
    std::uint64_t start_ns = 0, end_ns = 0;
    std::uint64_t messages = 0;
    void include(std::uint64_t time_ns);
  };

  void emit(ByteView bytes);
  std::uint64_t emit_record(bag::mcap::Op op, ByteView content);
  Bytes take_message_indexes(std::uint64_t start, Bytes& offsets);
  Bytes statistics() const;
  Bytes summary_groups(std::uint64_t start, Bytes& offsets) const;

  Sink sink_;
  McapWriterOptions options_;
  std::uint64_t size_ = 0;  // bytes given to the sink
  std::uint32_t crc_ = 0;   // of those bytes
  std::vector<bag::mcap::Schema> schemas_;
  std::vector<ChannelState> channels_;
  Bytes open_;  // records of the open chunk
  TimeSpan open_span_, file_span_;
  std::vector<Bytes> chunk_indexes_, metadata_indexes_;
};

}  // namespace astro::bag
