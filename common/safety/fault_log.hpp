#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "common/base/nor_flash.hpp"
#include "common/base/serial_number.hpp"
#include "common/safety/fault_record.hpp"

namespace astro {

/// The faults of this start and of earlier ones, in flash: a ring of slots through all sectors. If all slots
/// are full the oldest sector is erased. A power cut loses at most the entry that is being written; with two
/// sectors the newest kSlots entries always survive.
///
/// A slot that cannot be read or does not take an entry is skipped. If no other sector takes an entry, the
/// newest sector itself is erased: the present fault is worth more than earlier ones.
///
/// Holds no state: everything is read from the flash.
///
/// Flash   at least two sectors. Written only while the wheels have stopped and the outputs are off.
/// Cost    each call reads all slots, 128 on the reference robot; append programs one, and erases a sector
///         each time one is full. No heap; 64 bytes of stack.
template <NorFlash Flash>
class FaultLog {
 public:
  /// Longer than an entry, so that a later format can say more and entries of two formats can lie side by
  /// side.
  static constexpr std::uint32_t kSlotBytes = std::max<std::uint32_t>(64, Flash::kProgramBytes);
  static constexpr std::uint32_t kSlots = Flash::kSectorBytes / kSlotBytes;  // of a sector
  static_assert(Flash::kSectors >= 2, "one sector is erased while another holds the newest entries");
  static_assert(kSlotBytes % Flash::kProgramBytes == 0);

  explicit FaultLog(Flash& flash) : flash_(flash) {}

  /// Shows entries to `more`, the newest first, until it returns false or all have been shown.
  template <class More>
  void walk(More&& more) const {
    const Place newest = this->newest();
    if (!newest.found || !more(newest.entry)) return;
    // Backwards round the ring. A newer entry can only be left over from a failed erase, so it is skipped.
    std::uint32_t last = newest.entry.number;
    for (std::uint32_t back = 1; back < kAll; ++back) {
      const auto older = read((newest.at + kAll - back) % kAll);
      if (!older || !is_newer(last, older->number)) continue;
      if (!more(*older)) return;
      last = older->number;
    }
  }

  /// The entry that came `index` entries before the newest, or nothing.
  std::optional<LoggedFault> get(std::uint32_t index) const {
    std::optional<LoggedFault> found;
    walk([&](const LoggedFault& entry) {
      if (index-- == 0) found = entry;
      return !found;
    });
    return found;
  }

  /// Writes `was` as the newest entry. False if no sector takes it.
  bool append(const FaultCircumstances& was, std::uint32_t start) {
    const Place newest = this->newest();
    const Written bytes = written({newest.found ? newest.entry.number + 1 : 1, start, was});
    const std::uint32_t sector = newest.found ? newest.at / kSlots : Flash::kSectors - 1;
    if (newest.found && write(sector, newest.at % kSlots + 1, bytes)) return true;
    for (std::uint32_t step = 1; step <= Flash::kSectors; ++step) {
      const std::uint32_t next = (sector + step) % Flash::kSectors;
      static_cast<void>(flash_.erase(next));  // also where it looks blank: a cut erase can leave it so
      if (write(next, 0, bytes)) return true;
    }
    return false;
  }

  /// What an entry takes of its slot. The rest of the slot belongs to others: the log never reads or writes
  /// it.
  static constexpr std::uint32_t kWrittenBytes =
      (kFaultRecordBytes + Flash::kProgramBytes - 1) / Flash::kProgramBytes * Flash::kProgramBytes;

 private:
  static constexpr std::uint32_t kAll = kSlots * Flash::kSectors;
  using Written = std::array<std::uint8_t, kWrittenBytes>;

  struct Place {
    bool found = false;
    std::uint32_t at = 0;  // slots from the beginning of the first sector
    LoggedFault entry;
  };

  static constexpr std::uint32_t offset(std::uint32_t slot) {
    return slot / kSlots * Flash::kSectorBytes + slot % kSlots * kSlotBytes;
  }

  static Written written(const LoggedFault& entry) {
    Written bytes;
    bytes.fill(0xFF);
    std::ranges::copy(encode(entry), bytes.begin());
    return bytes;
  }

  std::optional<LoggedFault> read(std::uint32_t slot) const {
    FaultRecord record{};
    flash_.read(offset(slot), record);
    return decode(record);
  }

  Place newest() const {
    Place newest;
    for (std::uint32_t slot = 0; slot < kAll; ++slot) {
      const auto entry = read(slot);
      if (!entry || (newest.found && is_newer(newest.entry.number, entry->number))) continue;
      newest = {true, slot, *entry};
    }
    return newest;
  }

  /// Writes to the first blank slot of the sector, from `slot` on, that reads back as written.
  bool write(std::uint32_t sector, std::uint32_t slot, const Written& bytes) {
    for (; slot < kSlots; ++slot) {
      const std::uint32_t at = offset(sector * kSlots + slot);
      Written held;
      flash_.read(at, held);
      if (!is_blank(held)) continue;
      static_cast<void>(flash_.program(at, bytes));
      flash_.read(at, held);
      if (held == bytes) return true;
    }
    return false;
  }

  Flash& flash_;
};

}  // namespace astro
