#include "host/recording/mcap/record_stream.hpp"

#include <algorithm>

#include "host/recording/mcap/compression.hpp"

namespace astro::recording::mcap {
namespace {

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

}  // namespace

RecordStream::RecordStream(ByteSource& file, std::uint64_t most_bytes)
    : file_(file),
      most_bytes_(most_bytes),
      at_(sizeof kMagic),
      crc_(crc32_ieee(file.read(0, sizeof kMagic))) {}

bool RecordStream::next(Record& record) {
  record.start = at_;
  if (file_.size() - at_ < kRecordHeadBytes) return false;
  ByteCursor head(file_.read(at_, kRecordHeadBytes));
  record.op = head.number<std::uint8_t>();
  const auto length = head.number<std::uint64_t>();
  if (record.op == 0 || length > file_.size() - at_ - kRecordHeadBytes) return false;
  const std::uint64_t end = at_ + kRecordHeadBytes + length;
  record.content = {};
  const bool is_held = is_needed(static_cast<Op>(record.op));
  record.is_too_large = is_held && length > most_bytes_;
  crc_before_ = crc_;
  if (is_held && !record.is_too_large) {
    const ByteView whole = file_.read(at_, static_cast<std::size_t>(end - at_));
    crc_ = crc32_ieee(whole, crc_);
    record.content = whole.subspan(kRecordHeadBytes);
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

bool next_inside(ByteCursor& cursor, Record& record) {
  record.op = cursor.number<std::uint8_t>();
  record.content = cursor.take(cursor.number<std::uint64_t>());
  return cursor.ok() && record.op != 0;
}

}  // namespace astro::recording::mcap
