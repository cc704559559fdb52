#include "host/emulator/chip/iomuxc.hpp"

#include <algorithm>

namespace astro::emulator {
namespace {

using namespace teensy40;

constexpr std::uint32_t kCodeOn = 1U << 0, kDataOn = 1U << 1, kBanksByRegister = 1U << 2;  // GPR16
constexpr std::uint32_t kRomVectors = 0x0020'0000;                                         // GPR16
constexpr std::uint32_t kOcramBank = 1, kDataBank = 2, kCodeBank = 3;                      // GPR17

std::uint32_t banks(std::uint32_t configuration, std::uint32_t kind) {
  std::uint32_t count = 0;
  for (std::uint32_t bank = 0; bank < 16; ++bank) count += (configuration >> (2 * bank) & 3) == kind ? 1 : 0;
  return count * Memory::kBank;
}

/// The size that the core allows for a tightly coupled memory: code 3 is 4 KB, each further code twice as
/// much. With code 0 the fuses decide.
std::uint32_t window(std::uint32_t code) { return code == 0 ? Memory::kFlexRam : 512U << code; }

}  // namespace

Memory::Layout IomuxcGpr::layout() const {
  const std::uint32_t control = value(iomuxc_gpr::GPR16.value), sizes = value(iomuxc_gpr::GPR14.value);
  Memory::Layout layout;
  if ((control & kBanksByRegister) != 0) {
    const std::uint32_t configuration = value(iomuxc_gpr::GPR17.value);
    layout = {banks(configuration, kCodeBank), banks(configuration, kDataBank),
              banks(configuration, kOcramBank)};
  }
  layout.itcm = (control & kCodeOn) == 0 ? 0 : std::min(layout.itcm, window(sizes >> 16 & 0xF));
  layout.dtcm = (control & kDataOn) == 0 ? 0 : std::min(layout.dtcm, window(sizes >> 20 & 0xF));
  return layout;
}

void IomuxcGpr::reset() {
  Stored::reset();
  on_layout(layout());
}

void IomuxcGpr::write(std::uint32_t offset, std::uint32_t word) {
  if (offset == iomuxc_gpr::GPR16.value && (word & ~0x7FU) != kRomVectors)
    machine_.fail({"IOMUXC_GPR GPR16: the vectors of the next reset must stay with the ROM",
                   FlexRamProblem::vectors_moved});
  const auto code = [word](int lsb) { return word >> lsb & 0xF; };
  if (offset == iomuxc_gpr::GPR14.value && (code(16) < 3 || code(16) > 10 || code(20) < 3 || code(20) > 10))
    machine_.fail({"IOMUXC_GPR GPR14: the sizes of the coupled memories are codes 3 (4 KB) to 10 (512 KB)",
                   FlexRamProblem::size_unknown});
  store(offset, word);
  if (offset == iomuxc_gpr::GPR14.value || offset == iomuxc_gpr::GPR16.value ||
      offset == iomuxc_gpr::GPR17.value)
    on_layout(layout());
}

}  // namespace astro::emulator
