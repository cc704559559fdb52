#include "hal/teensy40/flash.hpp"

#include <algorithm>

#include "hal/teensy40/clock.hpp"
#include "hal/teensy40/flexspi.hpp"
#include "hal/teensy40/watchdog.hpp"

namespace astro::teensy40 {
namespace {

namespace commands = flexspi_commands;

constexpr std::uint32_t kBase = 0x001F'0000;  // from the start of the flash
constexpr std::uint32_t kPageBytes = 256;
constexpr std::uint64_t kLongest_us = 1'000'000;
static_assert(kBase % Flash::kSectorBytes == 0 && kBase + Flash::kBytes <= 0x001F'F000,
              "the last sector is the boot loader's");

const volatile std::uint8_t* mapped(std::uint32_t offset) {
  return reinterpret_cast<const volatile std::uint8_t*>(std::uintptr_t{0x6000'0000 + kBase + offset});
}

/// False if the flash is still busy after kLongest_us.
bool wait_idle() {
  constexpr std::uint32_t kBusy = 1;
  const Clock clock;
  const std::uint64_t begun_us = clock.now_us();
  while ((commands::read_byte(kReadStatus) & kBusy) != 0) {
    watchdog::feed();
    if (clock.now_us() - begun_us > kLongest_us) return false;
  }
  return true;
}

/// Invalidates the whole area, not only what has changed: the processor may prefetch anything, and what it
/// has fetched from another sector while the flash was busy is not that sector's content.
void forget() { commands::end(kBase, Flash::kBytes); }

bool program_page(std::uint32_t offset, std::span<const std::uint8_t> bytes) {
  return commands::run(kWriteEnable, 0) && commands::write(kProgramPage, kBase + offset, bytes) &&
         wait_idle();
}

bool program_pages(std::uint32_t offset, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const std::size_t count = std::min<std::size_t>(bytes.size(), kPageBytes - offset % kPageBytes);
    if (!program_page(offset, bytes.first(count))) return false;
    offset += static_cast<std::uint32_t>(count);
    bytes = bytes.subspan(count);
  }
  return true;
}

}  // namespace

bool Flash::erase(std::uint32_t sector) noexcept {
  if (sector >= kSectors) return false;
  const std::uint32_t offset = sector * kSectorBytes;
  const bool done = commands::begin() && commands::run(kWriteEnable, 0) &&
                    commands::run(kEraseSector, kBase + offset) && wait_idle();
  forget();
  const auto* bytes = mapped(offset);
  return done && std::all_of(bytes, bytes + kSectorBytes, [](std::uint8_t byte) { return byte == 0xFF; });
}

bool Flash::program(std::uint32_t offset, std::span<const std::uint8_t> bytes) noexcept {
  if (offset >= kBytes || bytes.size() > kSectorBytes - offset % kSectorBytes) return false;
  if (offset % kProgramBytes != 0 || bytes.size() % kProgramBytes != 0) return false;
  const bool done = commands::begin() && program_pages(offset, bytes);
  forget();
  return done && std::equal(bytes.begin(), bytes.end(), mapped(offset));
}

void Flash::read(std::uint32_t offset, std::span<std::uint8_t> into) noexcept {
  for (std::uint8_t& byte : into) {
    byte = offset < kBytes ? *mapped(offset) : std::uint8_t{0xFF};
    ++offset;
  }
}

}  // namespace astro::teensy40
