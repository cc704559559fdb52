#pragma once

#include <functional>
#include <string>
#include <vector>

#include "host/recording/mcap/records.hpp"

namespace astro::recording {

/// What the reader hands out as it walks. The views live only during the call. `schema` is null for channels
/// without one. A handler that is empty is not called, and without `message` chunks are not even expanded.
struct McapHandlers {
  std::function<void(const mcap::Channel& channel, const mcap::Schema* schema, const mcap::Message& message)>
      message;
  std::function<void(const mcap::Metadata& metadata)> metadata;
};

/// Each in bytes. What a file may take grows with its own size, so that a small one cannot exhaust the memory
/// or the reader's patience by claims.
struct McapLimits {
  /// Of one expanded chunk, or the size of the file if that is more. Usual are 1 to 4 MiB.
  std::uint64_t chunk_bytes = std::uint64_t{32} << 20;
  /// Of all expanded chunks: so much, and beyond that `most_gain` times the file. Drives are packed 5 to 50
  /// times.
  std::uint64_t all_chunks_bytes = std::uint64_t{64} << 20;
  std::uint64_t most_gain = 256;
  /// Of all schemas and channels: so much, and beyond that the size of the file.
  std::uint64_t definition_bytes = std::uint64_t{16} << 20;
};

/// What became of the walk.
struct McapReport {
  bool is_mcap = false;    // false: the file does not begin like one; nothing else was looked at
  bool truncated = false;  // the end is missing; everything handed out before it is good
  // A checksum or a length inside the file is wrong; that part was left out, or, if the length of a record is
  // wrong, all that follows it. A file that ends as a whole one does is damaged, never truncated.
  bool damaged = false;
  std::string profile, library;
  std::vector<std::string> warnings;  // the first few reasons for the two, with places in the file
};

/// Walks an MCAP file from front to back. Needs no index, so that a file of a recorder that was killed reads
/// up to its last whole chunk; checks the checksum of every chunk, of the data section and of the summary;
/// skips records and trailing fields that it does not know. Whatever the bytes are, it ends, and allocates no
/// more than the limits allow. Throws only what a handler throws.
McapReport read_mcap(ByteView file, const McapHandlers& handlers, const McapLimits& limits = {});

}  // namespace astro::recording
