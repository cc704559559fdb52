#pragma once

#include "host/base/byte_source.hpp"
#include "host/recording/mcap/records.hpp"

namespace astro::recording::mcap {

struct Record {
  std::uint8_t op = 0;
  std::uint64_t start = 0;  // position in the file
  ByteView content;  // empty for records that no reader of ours needs: indexes, attachments, unknown ones
  bool is_too_large = false;  // needed, but larger than may be held; the content is empty
};

/// Walks over the records of a file and keeps the checksum of all that it has passed. One record is in memory at a
/// time, and those that nobody needs not even once as a whole.
class RecordStream {
 public:
  /// Precondition: the file has at least kMagicBytes. `most_bytes`: of a record that is held.
  RecordStream(ByteSource& file, std::uint64_t most_bytes);

  /// False if there is no whole record any more; `record.start` says where. Opcode 0 does not exist; a file system
  /// leaves zeros where a power cut prevented the writing of bytes.
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

/// The next record inside an expanded chunk; its start is not set. False as for RecordStream.
bool next_inside(ByteCursor& cursor, Record& record);

}  // namespace astro::recording::mcap
