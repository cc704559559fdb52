#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "common/base/nor_flash.hpp"
#include "common/base/serial_number.hpp"
#include "common/params/record.hpp"

namespace astro {

/// Records in flash. They are found whatever damage lies between them: interrupted writes and erases, rotten
/// bits. A record starts at a multiple of kUnit, so after damage the search continues at the next unit.
///
/// Holds no state: everything is read from the flash.
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
    bool found_outside = false;   // another sector has a record, too
    std::uint32_t outside = 0;    // the newest there: what remains if the sector of the newest is lost
    std::uint32_t skipped = 0;    // damaged places
    std::uint32_t claimed = 0;    // the newest sequence number that a damaged record claims
    bool damaged_record = false;  // there is a damaged record

    /// A damaged record claims to be newer: its bits rotted, or the power failed during its commit.
    bool outrun() const { return damaged_record && (!found || is_newer(claimed, sequence)); }

    std::uint32_t sector() const { return at / kSectorBytes; }
  };

  explicit RecordLog(Flash& flash) : flash_(flash) {}

  /// Reads all sectors once. Leaves the newest intact record in `record`, or an empty one if there is none.
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

  /// Writes after everything that is in the sector. False if no room is left that reads back as written.
  bool append(std::uint32_t sector, const Record& record) {
    const std::uint32_t start = sector * kSectorBytes;
    // After the last byte that is not blank: the length in an interrupted record cannot be trusted.
    std::uint32_t at = start + kSectorBytes;
    while (at > start && is_blank(read_unit(at - kUnit))) at -= kUnit;
    return write_from(at, start + kSectorBytes, record);
  }

  /// Erases the sector and writes at its start. Erases it even if it looks blank, because cells that an
  /// interrupted erase has left may just read as 1. The result of erase() does not matter: a cell that did
  /// not erase damages the record that lies on it and no other.
  bool restart(std::uint32_t sector, const Record& record) {
    static_cast<void>(flash_.erase(sector));
    return write_from(sector * kSectorBytes, (sector + 1) * kSectorBytes, record);
  }

 private:
  using Unit = std::array<std::uint8_t, kUnit>;

  static constexpr std::uint32_t padded(std::size_t bytes) {
    return (static_cast<std::uint32_t>(bytes) + kUnit - 1) / kUnit * kUnit;
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
      const bool damaged = !is_blank(unit);
      if (damaged && (!in_damage || Record::has_magic(unit))) ++newest.skipped;
      if (Record::has_magic(unit)) note_damaged(Record::announced_sequence(unit), newest);
      in_damage = damaged;
      at += kUnit;
    }
  }

  /// `here` continues `newest` through one more sector, and holds the newest record of that sector only.
  static void merge(Newest here, Newest& newest) {
    const bool wins = here.found && (!newest.found || is_newer(here.sequence, newest.sequence));
    const Newest& left = wins ? newest : here;  // the one that is not the newest
    if (left.found && (!newest.found_outside || is_newer(left.sequence, newest.outside))) {
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

  static void note(std::uint32_t at, std::uint32_t sequence, Newest& newest) {
    if (newest.found && !is_newer(sequence, newest.sequence)) return;
    newest.found = true;
    newest.at = at;
    newest.sequence = sequence;
  }

  static void note_damaged(std::uint32_t sequence, Newest& newest) {
    if (newest.damaged_record && !is_newer(sequence, newest.claimed)) return;
    newest.damaged_record = true;
    newest.claimed = sequence;
  }

  /// If a stuck cell keeps the record from reading back as written, the next place is tried.
  bool write_from(std::uint32_t at, std::uint32_t end, const Record& record) {
    for (; end - at >= padded(record.size()); at += padded(record.size()))
      if (write(at, record)) return true;
    return false;
  }

  /// Reads the record back; the result of program() does not matter, because the next search goes by the
  /// bytes.
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
