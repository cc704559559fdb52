#include "common/params/record.hpp"

#include <algorithm>
#include <cstring>

#include "common/base/crc32.hpp"
#include "common/base/little_endian.hpp"

namespace astro {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::array<std::uint8_t, 4> kMagic{'A', 'S', 'T', 'P'};
constexpr std::uint8_t kFormatVersion = 1;
constexpr std::size_t kRowHeaderBytes = 3;
constexpr std::size_t kNumberBytes = 4;

constexpr std::size_t value_bytes(const ParamRow& row) {
  return row.kind == ParamKind::text ? ParamText::kCapacity : kNumberBytes;
}

constexpr std::size_t kOwnRowsBytes = [] {
  std::size_t bytes = 0;
  for (const ParamRow& row : kParamTable) bytes += kRowHeaderBytes + value_bytes(row);
  return bytes;
}();
static_assert(Record::kHeaderBytes + kOwnRowsBytes + Record::kCrcBytes <= Record::kMaxBytes / 2,
              "half the record is reserved for rows of later firmware");

/// A row in a payload.
struct StoredRow {
  const ParamRow* known;  // nullptr: an id that the table does not have
  Bytes whole;
  Bytes value;
};

/// Precondition: rows_are_readable().
StoredRow first_row(Bytes rows) {
  const std::size_t size = rows[2];
  return {find_param(load_little_endian<std::uint16_t>(&rows[0])), rows.first(kRowHeaderBytes + size),
          rows.subspan(kRowHeaderBytes, size)};
}

bool rows_are_readable(Bytes rows) {
  while (!rows.empty()) {
    if (rows.size() < kRowHeaderBytes || rows.size() - kRowHeaderBytes < rows[2]) return false;
    const StoredRow row = first_row(rows);
    if (row.known != nullptr && row.value.size() != value_bytes(*row.known)) return false;
    rows = rows.subspan(row.whole.size());
  }
  return true;
}

ParamText text_of(Bytes value) {
  std::array<char, ParamText::kCapacity> characters{};
  std::ranges::transform(value, characters.begin(),
                         [](std::uint8_t byte) { return static_cast<char>(byte); });
  return ParamText(std::string_view(characters.data(), characters.size()));
}

void put_row(std::span<std::uint8_t> room, const ParamRow& row, const ParameterSet& set) {
  const std::size_t size = value_bytes(row);
  store_little_endian(&room[0], static_cast<std::uint16_t>(row.id));
  room[2] = static_cast<std::uint8_t>(size);
  const auto value = room.subspan(kRowHeaderBytes, size);
  if (row.kind == ParamKind::text) {
    std::ranges::transform(set.text(row.id).characters(), value.begin(),
                           [](char c) { return static_cast<std::uint8_t>(c); });
  } else {
    store_little_endian(&value[0], static_cast<std::uint32_t>(set.get(row.id)));
  }
}

}  // namespace

bool Record::has_magic(Bytes bytes) { return std::ranges::equal(bytes.first(kMagic.size()), kMagic); }

std::size_t Record::announced_bytes(Bytes header) {
  if (!has_magic(header) || header[4] != kFormatVersion) return 0;
  const std::size_t size = kHeaderBytes + load_little_endian<std::uint16_t>(&header[6]) + kCrcBytes;
  return size <= kMaxBytes ? size : 0;
}

std::uint32_t Record::announced_sequence(Bytes header) {
  return load_little_endian<std::uint32_t>(&header[8]);
}

std::span<std::uint8_t> Record::room(std::size_t size) {
  size_ = std::min(size, kMaxBytes);
  return std::span(bytes_).first(size_);
}

Bytes Record::payload() const {
  return Bytes(bytes_).subspan(kHeaderBytes, size_ - kHeaderBytes - kCrcBytes);
}

bool Record::intact() const {
  if (size_ < kHeaderBytes + kCrcBytes || announced_bytes(bytes_) != size_) return false;
  const Bytes covered = Bytes(bytes_).first(size_ - kCrcBytes);
  if (crc32(covered) != load_little_endian<std::uint32_t>(&bytes_[covered.size()])) return false;
  return rows_are_readable(payload());
}

std::uint32_t Record::sequence() const { return announced_sequence(bytes_); }

ParameterSet Record::set() const {
  ParameterSet set = ParameterSet::defaults();
  for (Bytes rows = payload(); !rows.empty();) {
    const StoredRow row = first_row(rows);
    rows = rows.subspan(row.whole.size());
    if (row.known == nullptr) continue;
    if (row.known->kind == ParamKind::text) {
      set.set_text(row.known->id, text_of(row.value));
    } else {
      set.set(row.known->id, static_cast<std::int32_t>(load_little_endian<std::uint32_t>(&row.value[0])));
    }
  }
  return set;
}

/// Moves the unknown rows to the front of the payload; returns their size.
std::size_t Record::keep_unknown_rows() {
  if (!intact()) return 0;
  std::size_t kept = 0;
  for (Bytes rows = payload(); !rows.empty();) {
    const StoredRow row = first_row(rows);
    rows = rows.subspan(row.whole.size());
    if (row.known != nullptr) continue;
    std::memmove(&bytes_[kHeaderBytes + kept], row.whole.data(), row.whole.size());
    kept += row.whole.size();
  }
  return kept;
}

bool Record::rewrite(const ParameterSet& set, std::uint32_t sequence) {
  std::size_t end = kHeaderBytes + keep_unknown_rows();
  size_ = 0;
  if (end + kOwnRowsBytes + kCrcBytes > kMaxBytes) return false;
  for (const ParamRow& row : kParamTable) {
    put_row(std::span(bytes_).subspan(end), row, set);
    end += kRowHeaderBytes + value_bytes(row);
  }
  close(end - kHeaderBytes, sequence);
  return true;
}

/// Writes header and CRC around the payload.
void Record::close(std::size_t payload_bytes, std::uint32_t sequence) {
  const std::span<std::uint8_t> bytes(bytes_);
  std::ranges::copy(kMagic, bytes.begin());
  bytes[4] = kFormatVersion;
  bytes[5] = 0;
  store_little_endian(&bytes[6], static_cast<std::uint16_t>(payload_bytes));
  store_little_endian(&bytes[8], sequence);
  const std::size_t covered = kHeaderBytes + payload_bytes;
  store_little_endian(&bytes[covered], crc32(bytes.first(covered)));
  size_ = covered + kCrcBytes;
  std::ranges::fill(bytes.subspan(size_), std::uint8_t{0xFF});
}

}  // namespace astro
