#include "common/safety/fault_record.hpp"

#include <algorithm>

#include "common/base/crc32.hpp"

namespace astro {
namespace {

constexpr std::array<std::uint8_t, 4> kMagic{'A', 'S', 'F', 1};
constexpr std::size_t kCovered = kFaultRecordBytes - 4;

void store(FaultRecord& record, std::size_t at, std::size_t size, std::uint64_t value) {
  for (std::size_t i = 0; i < size; ++i) record[at + i] = static_cast<std::uint8_t>(value >> (8 * i));
}

std::uint32_t load(const FaultRecord& record, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = (value << 8) | record[at + i];
  return value;
}

std::uint32_t crc_of(const FaultRecord& record) { return crc32(std::span(record).first(kCovered)); }

}  // namespace

FaultRecord encode(const LoggedFault& entry) {
  FaultRecord record{};
  std::ranges::copy(kMagic, record.begin());
  record[4] = static_cast<std::uint8_t>(entry.was.fault);
  record[5] = entry.was.mode;
  store(record, 6, 2, entry.was.missed);
  store(record, 8, 4, entry.number);
  store(record, 12, 4, entry.start);
  store(record, 16, 8, entry.was.time_us);
  store(record, 24, 4, static_cast<std::uint32_t>(entry.was.battery_mv));
  store(record, 28, 4, static_cast<std::uint32_t>(entry.was.left_umps));
  store(record, 32, 4, static_cast<std::uint32_t>(entry.was.right_umps));
  store(record, kCovered, 4, crc_of(record));
  return record;
}

std::optional<LoggedFault> decode(const FaultRecord& record) {
  if (!std::ranges::equal(kMagic, std::span(record).first(kMagic.size()))) return {};
  if (load(record, kCovered) != crc_of(record)) return {};
  LoggedFault entry;
  entry.was.fault = static_cast<Fault>(record[4]);
  entry.was.mode = record[5];
  entry.was.missed = static_cast<std::uint16_t>(record[6] | record[7] << 8);
  entry.number = load(record, 8);
  entry.start = load(record, 12);
  entry.was.time_us = load(record, 16) | std::uint64_t{load(record, 20)} << 32;
  entry.was.battery_mv = static_cast<std::int32_t>(load(record, 24));
  entry.was.left_umps = static_cast<std::int32_t>(load(record, 28));
  entry.was.right_umps = static_cast<std::int32_t>(load(record, 32));
  return entry;
}

}  // namespace astro
