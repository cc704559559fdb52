#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/base/byte_source.hpp"
#include "host/base/error.hpp"
#include "host/formats/files/mcap_records.hpp"

namespace astro::bag {

/// Callbacks of the reader. The views are valid only during the call. `schema` is null for channels without
/// one. An empty handler is not called, and without `message` chunks are not even expanded.
struct McapHandlers {
  std::function<void(const bag::mcap::Channel& channel, const bag::mcap::Schema* schema,
                     const bag::mcap::Message& message)>
      message;
  std::function<void(const bag::mcap::Metadata& metadata)> metadata;
};

/// Limits in bytes. They grow with the size of the file, so that a small file with false sizes cannot exhaust
/// memory or time.
struct McapLimits {
  /// The size of the file from which this one was unpacked, if it was.
  std::optional<std::uint64_t> packed_bytes;
  /// Limit for one record or expanded chunk; the size of the file if that is more. Usual chunks have 1 to 4 MiB.
  std::uint64_t chunk_bytes = std::uint64_t{32} << 20;
  /// Limit for all expanded chunks together: this plus `most_gain` times the size of the file. Drives compress by a factor of
  /// 5 to 50.
  std::uint64_t all_chunks_bytes = std::uint64_t{64} << 20;
  std::uint64_t most_gain = 256;
  /// Limit for all schemas and channels together: this plus the size of the file.
  std::uint64_t definition_bytes = std::uint64_t{16} << 20;
};

/// What is wrong with an MCAP file. Values: the position in the file; of bad_record also what it should be.
enum class McapProblem {
  cut_off,
  record_beyond_end,
  record_too_large,
  bad_record,
  unknown_channel,
  too_many_definitions,
  chunk_too_large,
  chunks_expand_too_far,
  chunk_does_not_expand,
  chunk_ends_inside_record,
  wrong_chunk_checksum,
  wrong_data_checksum,
  wrong_summary_checksum,
  no_data_end,
  no_end_mark
};

/// The result of reading.
struct McapReport {
  bool is_mcap = false;    // false: the file does not begin like one; nothing else was looked at
  bool truncated = false;  // the end is missing; everything before it is good
  // A checksum or a length inside the file is wrong. That part was left out; if the length of a record is
  // wrong, everything after it. A file with an intact end is damaged, never truncated.
  bool damaged = false;
  std::string profile, library;
  std::vector<Remark> warnings;  // the first few reasons for the two, of McapProblem
};

/// Reads an MCAP file from front to back. Needs no index, so that the file of a recorder that was killed can
/// be read up to its last whole chunk. Checks the checksum of every chunk, of the data section and of the
/// summary; skips unknown records and trailing fields. Terminates for all input, and allocates no more than
/// the limits allow. Throws only what a handler throws.
McapReport read_mcap(ByteView file, const McapHandlers& handlers, const McapLimits& limits = {});

/// The same for a file of any size, with one record of it in memory at a time. Throws what the source throws, too.
McapReport read_mcap(ByteSource& file, const McapHandlers& handlers, const McapLimits& limits = {});

}  // namespace astro::bag
