#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace astro {

/// Something that hosts are told without asking.
struct HostEvent {
  enum class Kind : std::uint8_t {
    segment_started,
    segment_completed,
    segment_aborted,
    fault_raised,
    booted,
    slip_found
  };
  std::uint64_t time_us = 0;
  std::uint16_t number = 0;  // the segment's tag, the Fault, the ResetCause, or the turn in 1e-4 rad
  Kind kind = Kind::booted;
};

/// The newest events. Every port reads them at its own pace, so a port that nobody reads does not hold up the
/// others.
///
/// Overflow  If all places are taken the oldest event is dropped. A port that has not read it yet counts it
///           as missed, and its host gets the count before the next event.
/// Cost      note(): constant. 12 bytes per place, 8 per port. Main loop only.
template <int Ports>
class EventLog {
 public:
  static constexpr std::uint32_t kRoom = 64;  // a full queue of segments ends with 17 of them
  static_assert((kRoom & (kRoom - 1)) == 0, "the running totals must wrap at a multiple of it");

  void note(const HostEvent& event) {
    events_[total_ % kRoom] = {static_cast<std::uint32_t>(event.time_us),
                               static_cast<std::uint16_t>(event.time_us >> 32), event.number, event.kind};
    ++total_;
    for (Reader& reader : readers_) {
      if (total_ - reader.read <= kRoom) continue;
      ++reader.read;
      if (reader.missed != 0xFFFF) ++reader.missed;
    }
  }

  bool empty(int port) const { return of(port).read == total_; }
  /// The oldest event that this port has not read. Precondition: not empty().
  HostEvent front(int port) const {
    const Packed& event = events_[of(port).read % kRoom];
    return {std::uint64_t{event.time_high} << 32 | event.time_low, event.number, event.kind};
  }
  void pop(int port) { ++of(port).read; }

  /// Events that were dropped before this port read them, since forget_missed(). Counts up to 65535.
  std::uint16_t missed(int port) const { return of(port).missed; }
  void forget_missed(int port) { of(port).missed = 0; }

  /// A new host has begun at this port: it does not get what the host before it has not read.
  void skip(int port) { of(port) = {total_, 0}; }

 private:
  struct Packed {
    std::uint32_t time_low = 0;
    std::uint16_t time_high = 0;  // 48 bits of microseconds are nine years
    std::uint16_t number = 0;
    HostEvent::Kind kind{};
  };
  struct Reader {
    std::uint32_t read = 0;  // a running total like total_
    std::uint16_t missed = 0;
  };
  Reader& of(int port) { return readers_[static_cast<std::size_t>(port)]; }
  const Reader& of(int port) const { return readers_[static_cast<std::size_t>(port)]; }

  std::array<Packed, kRoom> events_{};
  std::array<Reader, Ports> readers_{};
  std::uint32_t total_ = 0;
};

}  // namespace astro
