#include "common/safety/fault_record.hpp"

#include <algorithm>

#include "common/base/crc32.hpp"
#include "common/base/little_endian.hpp"

namespace astro {
namespace {

constexpr std::array<std::uint8_t, 4> kMagic{'A', 'S', 'F', 1};
constexpr std::size_t kCovered = kFaultRecordBytes - 4;

std::uint32_t crc_of(const FaultRecord& record) { return crc32(std::span(record).first(kCovered)); }

}  // namespace

FaultRecord encode(const LoggedFault& entry) {
  FaultRecord record{};
  std::ranges::copy(kMagic, record.begin());
  record[4] = static_cast<std::uint8_t>(entry.was.fault);
  record[5] = entry.was.mode;
  store_little_endian(&record[6], entry.was.missed);
  store_little_endian(&record[8], entry.number);
  store_little_endian(&record[12], entry.start);
  store_little_endian(&record[16], entry.was.time_us);
  store_little_endian(&record[24], static_cast<std::uint32_t>(entry.was.battery_mv));
  store_little_endian(&record[28], static_cast<std::uint32_t>(entry.was.left_umps));
  store_little_endian(&record[32], static_cast<std::uint32_t>(entry.was.right_umps));
  store_little_endian(&record[kCovered], crc_of(record));
  return record;
}

std::optional<LoggedFault> decode(const FaultRecord& record) {
  if (!std::ranges::equal(kMagic, std::span(record).first(kMagic.size()))) return {};
  if (load_little_endian<std::uint32_t>(&record[kCovered]) != crc_of(record)) return {};
  LoggedFault entry;
  entry.was.fault = static_cast<Fault>(record[4]);
  entry.was.mode = record[5];
  entry.was.missed = load_little_endian<std::uint16_t>(&record[6]);
  entry.number = load_little_endian<std::uint32_t>(&record[8]);
  entry.start = load_little_endian<std::uint32_t>(&record[12]);
  entry.was.time_us = load_little_endian<std::uint64_t>(&record[16]);
  entry.was.battery_mv = static_cast<std::int32_t>(load_little_endian<std::uint32_t>(&record[24]));
  entry.was.left_umps = static_cast<std::int32_t>(load_little_endian<std::uint32_t>(&record[28]));
  entry.was.right_umps = static_cast<std::int32_t>(load_little_endian<std::uint32_t>(&record[32]));
  return entry;
}

}  // namespace astro
