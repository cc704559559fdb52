#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <span>

#include "common/params/record.hpp"

namespace astro {

/// NOR flash in sectors: erase makes every byte of one sector 0xFF, program clears bits in whole units of
/// kProgramBytes within one sector, a power cut leaves any mixture of old and new bits in the bytes under
/// way.
template <class T>
concept ParameterFlash = requires(T& flash, std::uint32_t at, std::span<std::uint8_t> into,
                                  std::span<const std::uint8_t> bytes) {
  { T::kSectors } -> std::convertible_to<std::uint32_t>;
  { T::kSectorBytes } -> std::convertible_to<std::uint32_t>;
  { T::kProgramBytes } -> std::convertible_to<std::uint32_t>;
  { flash.erase(at) } -> std::same_as<bool>;
  { flash.program(at, bytes) } -> std::same_as<bool>;
  { flash.read(at, into) } -> std::same_as<void>;
};

/// Records in flash, found again whatever lies between them: torn writes, cut erases, rotten bits. A record
/// starts at a multiple of kUnit, so behind any damage the search goes on at the next unit.
///
/// Holds no state: what the flash says is all there is.
template <ParameterFlash Flash>
class RecordLog {
 public:
  static constexpr std::uint32_t kSectors = Flash::kSectors;
  static constexpr std::uint32_t kSectorBytes = Flash::kSectorBytes;
  static constexpr std::uint32_t kUnit = std::max<std::uint32_t>(Flash::kProgramBytes, 16);
  static_assert(kSectorBytes >= Record::kMaxBytes && kSectorBytes % kUnit == 0);
  static_assert(kUnit % Flash::kProgramBytes == 0 && Record::kMaxBytes % kUnit == 0);

  struct Newest {
    bool found = false;
    std::uint32_t at = 0;
    std::uint32_t sequence = 0;
    std::uint32_t skipped = 0;  // damaged places met on the way

    std::uint32_t sector() const { return at / kSectorBytes; }
  };

  explicit RecordLog(Flash& flash) : flash_(flash) {}

  /// Reads all sectors once and leaves the newest intact record in `record`, an empty one if there is none.
  Newest newest(Record& record) const {
    Newest newest;
    for (std::uint32_t sector = 0; sector < kSectors; ++sector) search(sector * kSectorBytes, record, newest);
    record.room(0);
    if (newest.found) read(newest.at, (newest.sector() + 1) * kSectorBytes, record);
    return newest;
  }

  /// Writes behind everything that is in the sector; false if there is no room or the read-back differs.
  bool append(std::uint32_t sector, const Record& record) {
    const std::uint32_t start = sector * kSectorBytes;
    const std::uint32_t end = start + kSectorBytes;
    // Behind the last byte that is not blank: a torn record has no length to trust.
    std::uint32_t at = end;
    while (at > start && blank(read_unit(at - kUnit))) at -= kUnit;
    return end - at >= padded(record.size()) && write(at, record);
  }

  /// Erases the sector, though it may look blank after a cut erase, and writes at its start.
  bool restart(std::uint32_t sector, const Record& record) {
    return flash_.erase(sector) && write(sector * kSectorBytes, record);
  }

 private:
  using Unit = std::array<std::uint8_t, kUnit>;

  static constexpr std::uint32_t padded(std::size_t bytes) {
    return (static_cast<std::uint32_t>(bytes) + kUnit - 1) / kUnit * kUnit;
  }
  static bool blank(const Unit& unit) {
    return std::ranges::all_of(unit, [](std::uint8_t byte) { return byte == 0xFF; });
  }

  Unit read_unit(std::uint32_t at) const {
    Unit unit{};
    flash_.read(at, unit);
    return unit;
  }

  bool read(std::uint32_t at, std::uint32_t end, Record& record) const {
    const std::size_t size = Record::announced_bytes(read_unit(at));
    if (size == 0 || size > end - at) return false;
    flash_.read(at, record.room(size));
    return record.intact();
  }

  void search(std::uint32_t start, Record& record, Newest& newest) const {
    const std::uint32_t end = start + kSectorBytes;
    bool in_damage = false;
    for (std::uint32_t at = start; at < end;) {
      if (read(at, end, record)) {
        note(at, record.sequence(), newest);
        at += padded(record.size());
        in_damage = false;
        continue;
      }
      const Unit unit = read_unit(at);
      const bool damaged = !blank(unit);
      if (damaged && (!in_damage || Record::has_magic(unit))) ++newest.skipped;
      in_damage = damaged;
      at += kUnit;
    }
  }

  /// Sequence numbers are serial numbers (RFC 1982): the records in flash lie far less than 2^31 apart.
  static void note(std::uint32_t at, std::uint32_t sequence, Newest& newest) {
    if (newest.found && static_cast<std::int32_t>(sequence - newest.sequence) <= 0) return;
    newest.found = true;
    newest.at = at;
    newest.sequence = sequence;
  }

  /// The record's own bytes decide, not what program() says: they alone make the next search find it or not.
  bool write(std::uint32_t at, const Record& record) {
    static_cast<void>(flash_.program(at, record.bytes(padded(record.size()))));
    const auto wanted = record.bytes(record.size());
    for (std::uint32_t offset = 0; offset < wanted.size(); offset += kUnit) {
      const Unit held = read_unit(at + offset);
      const auto piece = wanted.subspan(offset, std::min<std::size_t>(kUnit, wanted.size() - offset));
      if (!std::ranges::equal(piece, std::span(held).first(piece.size()))) return false;
    }
    return true;
  }

  Flash& flash_;
};

}  // namespace astro
