#include "host/emulator/chip/flash_chip.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace astro::emulator {
namespace {

constexpr std::uint32_t kSectorBytes = 4096, kPageBytes = 256;

}  // namespace

void FlashChip::restore_power() {
  faults_.restore_power();
  enabled_ = false;
  busy_until_ = 0;
  on_busy(false);
}

/// Called by all commands except the one for the status.
void FlashChip::refuse_while_busy() {
  if (busy()) machine_.fail({"NOR flash: a command while the last one runs is ignored", FlashProblem::busy});
}

void FlashChip::write_enable() {
  refuse_while_busy();
  enabled_ = true;
}

std::array<std::uint8_t, 3> FlashChip::identity() {
  refuse_while_busy();
  return {0xEF, 0x40, 0x15};
}

bool FlashChip::begin(std::uint32_t address, Cycles takes) {
  refuse_while_busy();
  if (!enabled_)
    machine_.fail({"NOR flash: programming or erasing without write enable (0x06) is ignored",
                   FlashProblem::not_write_enabled});
  if (address < kParameters || address >= kParametersEnd)
    machine_.fail(
        {fmt::format(
             "NOR flash: 0x{:06X} does not belong to the parameters: the program or the boot loader is there",
             address),
         FlashProblem::outside_parameters,
         {fmt::format("0x{:06X}", address)}});
  enabled_ = false;
  busy_until_ = machine_.now() + takes;
  on_busy(true);
  machine_.wake(*this, busy_until_);
  return powered() && address >= kParameters && address < kParametersEnd;
}

void FlashChip::erase_sector(std::uint32_t address) {
  if (!begin(address, times.erase)) return;
  const std::uint32_t first = address / kSectorBytes * kSectorBytes;
  faults_.erase(first, content_.subspan(first, kSectorBytes));
}

void FlashChip::program(std::uint32_t address, std::span<const std::uint8_t> bytes) {
  if (bytes.size() > kPageBytes)
    machine_.fail({"NOR flash: more than a page is programmed at once", FlashProblem::more_than_a_page});
  if (!begin(address, times.page)) return;
  const std::uint32_t page = address / kPageBytes * kPageBytes;
  const std::size_t here = std::min<std::size_t>(bytes.size(), page + kPageBytes - address);
  faults_.program(address, content_.subspan(address, here), bytes.first(here));
  const auto around = bytes.subspan(here);
  faults_.program(page, content_.subspan(page, around.size()), around);
}

}  // namespace astro::emulator
