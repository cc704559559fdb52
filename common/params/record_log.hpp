#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "common/base/nor_flash.hpp"
#include "common/params/record.hpp"

namespace astro {

/// Records in flash, found again whatever lies between them: torn writes, cut erases, rotten bits. A record
/// starts at a multiple of kUnit, so behind any damage the search goes on at the next unit.
///
/// Holds no state: what the flash says is all there is.
template <NorFlash Flash>
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
    bool found_outside = false;   // also in another sector
    std::uint32_t outside = 0;    // the newest there: what is left if the newest's sector is lost
    std::uint32_t skipped = 0;    // damaged places met on the way
    std::uint32_t claimed = 0;    // by the damaged record that says it is the newest of them
    bool damaged_record = false;  // there is one

    /// A record that says it is newer is damaged: it rotted, or its commit was cut short.
    bool outrun() const {
      return damaged_record && (!found || static_cast<std::int32_t>(claimed - sequence) > 0);
    }

    std::uint32_t sector() const { return at / kSectorBytes; }
  };

  explicit RecordLog(Flash& flash) : flash_(flash) {}

  /// Reads all sectors once and leaves the newest intact record in `record`, an empty one if there is none.
  Newest newest(Record& record) const {
    Newest newest;
    for (std::uint32_t sector = 0; sector < kSectors; ++sector) {
      Newest here = newest;
      here.found = false;
      search(sector * kSectorBytes, record, here);
      merge(here, newest);
    }
    record.room(0);
    if (newest.found) read(newest.at, (newest.sector() + 1) * kSectorBytes, record);
    return newest;
  }

  /// Writes behind everything that is in the sector. False if there is no room, or none that reads back.
  bool append(std::uint32_t sector, const Record& record) {
    const std::uint32_t start = sector * kSectorBytes;
    // Behind the last byte that is not blank: a torn record has no length to trust.
    std::uint32_t at = start + kSectorBytes;
    while (at > start && blank(read_unit(at - kUnit))) at -= kUnit;
    return write_from(at, start + kSectorBytes, record);
  }

  /// Erases the sector, though it may look blank after a cut erase, and writes at its start. What erase()
  /// says does not matter: a cell that did not erase spoils the record that lies on it and no other.
  bool restart(std::uint32_t sector, const Record& record) {
    static_cast<void>(flash_.erase(sector));
    return write_from(sector * kSectorBytes, (sector + 1) * kSectorBytes, record);
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
      if (Record::has_magic(unit)) note_damaged(Record::announced_sequence(unit), newest);
      in_damage = damaged;
      at += kUnit;
    }
  }

  /// `here` has gone on from `newest` through one more sector, of which alone it holds the newest record.
  static void merge(Newest here, Newest& newest) {
    const bool wins =
        here.found && (!newest.found || static_cast<std::int32_t>(here.sequence - newest.sequence) > 0);
    const Newest& left = wins ? newest : here;  // the one that is not the newest
    if (left.found &&
        (!newest.found_outside || static_cast<std::int32_t>(left.sequence - newest.outside) > 0)) {
      here.found_outside = newest.found_outside = true;
      here.outside = newest.outside = left.sequence;
    }
    if (!wins) {
      here.found = newest.found;
      here.at = newest.at;
      here.sequence = newest.sequence;
    }
    newest = here;
  }

  /// Sequence numbers are serial numbers (RFC 1982): the records in flash lie far less than 2^31 apart.
  static void note(std::uint32_t at, std::uint32_t sequence, Newest& newest) {
    if (newest.found && static_cast<std::int32_t>(sequence - newest.sequence) <= 0) return;
    newest.found = true;
    newest.at = at;
    newest.sequence = sequence;
  }

  static void note_damaged(std::uint32_t sequence, Newest& newest) {
    if (newest.damaged_record && static_cast<std::int32_t>(sequence - newest.claimed) <= 0) return;
    newest.damaged_record = true;
    newest.claimed = sequence;
  }

  /// Where a cell is stuck the record does not read back, and is tried again behind it.
  bool write_from(std::uint32_t at, std::uint32_t end, const Record& record) {
    for (; end - at >= padded(record.size()); at += padded(record.size()))
      if (write(at, record)) return true;
    return false;
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
