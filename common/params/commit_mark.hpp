#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "common/base/crc32.hpp"
#include "common/base/nor_flash.hpp"

namespace astro {

/// A number that only grows, kept in what the slots of a log leave over at their ends: how far the
/// parameters' commits have come, remembered outside the parameters' own sectors. A start that finds only
/// older parameters then knows that newer ones are lost.
///
/// Every sector keeps it, so that the log may erase one at a time. A mark is 8 bytes, the number and a CRC-32
/// of it; the greatest that can be read counts. It never gets ahead of the number it was told, whenever the
/// power goes. If a sector has no place left the number stays behind: then it knows less, but nothing wrong.
///
/// SlotBytes  of the log's slots; UsedBytes: of these, what an entry takes.
/// Cost       each call reads the ends of all slots. No heap.
template <NorFlash Flash, std::uint32_t SlotBytes, std::uint32_t UsedBytes>
class CommitMark {
 public:
  static constexpr std::uint32_t kMarkBytes = std::max<std::uint32_t>(8, Flash::kProgramBytes);
  static constexpr std::uint32_t kBegin = (UsedBytes + kMarkBytes - 1) / kMarkBytes * kMarkBytes;
  static constexpr std::uint32_t kInSlot = kBegin < SlotBytes ? (SlotBytes - kBegin) / kMarkBytes : 0;
  static_assert(kInSlot > 0, "the log's slots leave no room for a mark");
  /// So often a sector can be told a greater number before the log erases it.
  static constexpr std::uint32_t kInSector = Flash::kSectorBytes / SlotBytes * kInSlot;

  explicit CommitMark(Flash& flash) : flash_(flash) {}

  /// Nothing if no sector has one.
  std::optional<std::uint32_t> newest() const {
    std::optional<std::uint32_t> newest;
    for (std::uint32_t sector = 0; sector < Flash::kSectors; ++sector)
      if (const auto held = look(sector).newest; held && (!newest || newer(*held, *newest))) newest = held;
    return newest;
  }

  /// From now on every sector knows of `number`.
  void raise(std::uint32_t number) {
    for (std::uint32_t sector = 0; sector < Flash::kSectors; ++sector) {
      const Sector held = look(sector);
      if (held.newest && !newer(number, *held.newest)) continue;
      const Mark mark = encode(number);
      for (std::uint32_t i = held.blank; i < kInSector; ++i) {
        if (read(sector, i) != kBlank) continue;
        static_cast<void>(flash_.program(offset(sector, i), mark));
        if (read(sector, i) == mark) break;
      }
    }
  }

  /// After the log has erased a sector.
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
    std::uint32_t blank = kInSector;  // the first place that is
  };

  /// Serial numbers (RFC 1982).
  static bool newer(std::uint32_t a, std::uint32_t b) { return static_cast<std::int32_t>(a - b) > 0; }

  static constexpr std::uint32_t offset(std::uint32_t sector, std::uint32_t i) {
    return sector * Flash::kSectorBytes + i / kInSlot * SlotBytes + kBegin + i % kInSlot * kMarkBytes;
  }
  static std::uint32_t word(const Mark& mark, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = (value << 8) | mark[at + i];
    return value;
  }
  static Mark encode(std::uint32_t number) {
    Mark mark = kBlank;
    for (std::size_t i = 0; i < 4; ++i) mark[i] = static_cast<std::uint8_t>(number >> (8 * i));
    const std::uint32_t crc = crc32(std::span(mark).first(4));
    for (std::size_t i = 0; i < 4; ++i) mark[4 + i] = static_cast<std::uint8_t>(crc >> (8 * i));
    return mark;
  }

  Mark read(std::uint32_t sector, std::uint32_t i) const {
    Mark mark{};
    flash_.read(offset(sector, i), mark);
    return mark;
  }

  Sector look(std::uint32_t sector) const {
    Sector found;
    for (std::uint32_t i = 0; i < kInSector; ++i) {
      const Mark mark = read(sector, i);
      if (mark == kBlank) {
        found.blank = std::min(found.blank, i);
      } else if (const std::uint32_t number = word(mark, 0);
                 word(mark, 4) == crc32(std::span(mark).first(4)) &&
                 (!found.newest || newer(number, *found.newest))) {
        found.newest = number;
      }
    }
    return found;
  }

  Flash& flash_;
};

}  // namespace astro
