#pragma once

#include <cstdint>

/// The data that the controller reads and writes in memory: a queue head for each direction of an endpoint,
/// and descriptors of transfers. All of it is in DTCM, which is not cached.
///
/// Source  the EHCI-like device controller of the i.MX RT family.
namespace astro::teensy40 {

inline constexpr std::uint32_t kEnd = 1;  // in place of an address: nothing follows
inline constexpr std::uint32_t kActive = 1U << 7, kHalted = 1U << 6;
inline constexpr std::uint32_t kInterruptWhenDone = 1U << 15;

struct alignas(32) Transfer {
  std::uint32_t next = kEnd, token = 0;
  std::uint32_t pages[5] = {};
  std::uint32_t spare = 0;
};
static_assert(sizeof(Transfer) == 32);

struct alignas(64) QueueHead {
  std::uint32_t capabilities = 0, current = 0, next = kEnd, token = 0;
  std::uint32_t pages[5] = {};
  std::uint32_t reserved = 0;
  std::uint32_t setup[2] = {};
  std::uint32_t spare[4] = {};
};
static_assert(sizeof(QueueHead) == 64);

/// Without this bit an empty packet ends a transfer of a whole number of packets.
inline constexpr std::uint32_t kNoEmptyPacket = 1U << 29, kInterruptOnSetup = 1U << 15;
constexpr std::uint32_t head_capabilities(std::uint32_t packet, std::uint32_t flags) {
  return packet << 16 | flags;
}

}  // namespace astro::teensy40
