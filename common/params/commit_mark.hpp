#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "common/base/crc32.hpp"
#include "common/base/little_endian.hpp"
#include "common/base/nor_flash.hpp"
#include "common/base/serial_number.hpp"

namespace astro {

/// The sequence number of the newest committed parameter set, kept outside the parameters' own sectors: in
/// the unused ends of a log's slots. A start that finds only an older set then knows that newer ones are
/// lost.
///
/// Every sector of the log keeps the number, so the log may erase one sector at a time. A mark is 8 bytes,
/// the number and its CRC-32; the newest one that can be read counts. Whenever the power fails, the mark is
/// never newer than the number that raise() was given. If a sector has no room left its mark stays older than
/// it should be, which hides a loss but never reports a false one.
///
/// SlotBytes  size of the log's slots
/// UsedBytes  what an entry takes of its slot
/// Cost       each call reads the ends of all slots; no heap
template <NorFlash Flash, std::uint32_t SlotBytes, std::uint32_t UsedBytes>
class CommitMark {
 public:
  static constexpr std::uint32_t kMarkBytes = std::max<std::uint32_t>(8, Flash::kProgramBytes);
  static constexpr std::uint32_t kBegin = (UsedBytes + kMarkBytes - 1) / kMarkBytes * kMarkBytes;
  static constexpr std::uint32_t kInSlot = kBegin < SlotBytes ? (SlotBytes - kBegin) / kMarkBytes : 0;
  static_assert(kInSlot > 0, "the log's slots leave no room for a mark");
  /// How often a sector's number can grow before the log has to erase the sector.
  static constexpr std::uint32_t kInSector = Flash::kSectorBytes / SlotBytes * kInSlot;

  explicit CommitMark(Flash& flash) : flash_(flash) {}

  /// Returns nothing if no sector has a mark.
  std::optional<std::uint32_t> newest() const {
    std::optional<std::uint32_t> newest;
    for (std::uint32_t sector = 0; sector < Flash::kSectors; ++sector)
      if (const auto held = scan(sector).newest; held && (!newest || is_newer(*held, *newest))) newest = held;
    return newest;
  }

  /// Writes `number` to every sector whose mark is older.
  void raise(std::uint32_t number) {
    for (std::uint32_t sector = 0; sector < Flash::kSectors; ++sector) {
      const Sector held = scan(sector);
      if (held.newest && !is_newer(number, *held.newest)) continue;
      const Mark mark = encode(number);
      for (std::uint32_t i = held.blank; i < kInSector; ++i) {
        if (read(sector, i) != kBlank) continue;
        static_cast<void>(flash_.program(offset(sector, i), mark));
        if (read(sector, i) == mark) break;
      }
    }
  }

  /// Call it after the log has erased a sector: writes the mark there again.
  void refresh() {
    if (const auto number = newest()) raise(*number);
  }

 private:
  using Mark = std::array<std::uint8_t, kMarkBytes>;
  static constexpr Mark kBlank = [] {
    Mark blank;
    blank.fill(0xFF);
    return blank;
  }();
  struct Sector {
    std::optional<std::uint32_t> newest;
    std::uint32_t blank = kInSector;  // the first blank place
  };

  static constexpr std::uint32_t offset(std::uint32_t sector, std::uint32_t i) {
    return sector * Flash::kSectorBytes + i / kInSlot * SlotBytes + kBegin + i % kInSlot * kMarkBytes;
  }
  static Mark encode(std::uint32_t number) {
    Mark mark = kBlank;
    store_little_endian(&mark[0], number);
    store_little_endian(&mark[4], crc32(std::span(mark).first(4)));
    return mark;
  }

  Mark read(std::uint32_t sector, std::uint32_t i) const {
    Mark mark{};
    flash_.read(offset(sector, i), mark);
    return mark;
  }

  Sector scan(std::uint32_t sector) const {
    Sector found;
    for (std::uint32_t i = 0; i < kInSector; ++i) {
      const Mark mark = read(sector, i);
      if (mark == kBlank) {
        found.blank = std::min(found.blank, i);
      } else if (const auto number = load_little_endian<std::uint32_t>(&mark[0]);
                 load_little_endian<std::uint32_t>(&mark[4]) == crc32(std::span(mark).first(4)) &&
                 (!found.newest || is_newer(number, *found.newest))) {
        found.newest = number;
      }
    }
    return found;
  }

  Flash& flash_;
};

}  // namespace astro
