#include "host/emulator/chip/nor_flash.hpp"

#include <fmt/format.h>

namespace astro::emulator {
namespace {

constexpr std::uint32_t kSector = 4096, kPage = 256;

// Which bits of a byte under way have changed when power fails: some, by a fixed hash.
std::uint8_t torn(std::uint8_t old, std::uint8_t target, std::uint32_t address) {
  std::uint32_t hash = (address + 1) * 0x9E37'79B9U;
  hash ^= hash >> 15;
  const auto bits = static_cast<std::uint8_t>(hash);
  return static_cast<std::uint8_t>((old & ~bits) | (target & bits));
}

}  // namespace

void NorFlash::cut_power_after(std::uint64_t bytes, sim::Tear tear) {
  cut_at_ = worked_ + bytes;
  tear_ = tear;
}

void NorFlash::restore_power() {
  powered_ = true;
  enabled_ = false;
  busy_until_ = 0;
  on_busy(false);
  cut_at_ = ~std::uint64_t{0};
}

/// All commands but the one for the status.
void NorFlash::refuse_while_busy() {
  if (busy()) machine_.fail("NOR flash: a command while the last one runs is ignored");
}

void NorFlash::write_enable() {
  refuse_while_busy();
  enabled_ = true;
}

std::array<std::uint8_t, 3> NorFlash::identity() {
  refuse_while_busy();
  return {0xEF, 0x40, 0x15};
}

bool NorFlash::begin(std::uint32_t address, Cycles takes) {
  refuse_while_busy();
  if (!enabled_) machine_.fail("NOR flash: programming or erasing without write enable (0x06) is ignored");
  if (address < kParameters || address >= kParametersEnd)
    machine_.fail(fmt::format(
        "NOR flash: 0x{:06X} is not the parameters': the program or the boot loader lies there", address));
  enabled_ = false;
  busy_until_ = machine_.now() + takes;
  on_busy(true);
  machine_.wake(*this, busy_until_);
  return powered_ && address >= kParameters && address < kParametersEnd;
}

void NorFlash::work(std::uint32_t address, std::uint8_t target) {
  if (!powered_) return;
  if (worked_ == cut_at_) {
    powered_ = false;
    if (tear_ == sim::Tear::torn) content_[address] = torn(content_[address], target, address);
    return;
  }
  content_[address] = target;
  ++worked_;
}

void NorFlash::erase_sector(std::uint32_t address) {
  if (!begin(address, times.erase)) return;
  const std::uint32_t first = address / kSector * kSector;
  for (std::uint32_t at = first; at < first + kSector; ++at) work(at, 0xFF);
}

void NorFlash::program(std::uint32_t address, std::span<const std::uint8_t> bytes) {
  if (bytes.size() > kPage) machine_.fail("NOR flash: more than a page is programmed at once");
  if (!begin(address, times.page)) return;
  const std::uint32_t page = address / kPage * kPage;
  for (const std::uint8_t byte : bytes) {
    work(address, content_[address] & byte);
    address = page + (address + 1) % kPage;
  }
}

}  // namespace astro::emulator
