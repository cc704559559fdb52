#include "host/emulator/core/protection.hpp"

#include "hal/teensy40/registers/registers.hpp"
#include "host/emulator/core/memory.hpp"

namespace astro::emulator {
namespace {

using namespace teensy40;

constexpr std::uint32_t kPrivilegedDefault = 1U << 2;  // CTRL.PRIVDEFENA
constexpr std::uint32_t kSubregions = 0xFF00;          // RASR.SRD

bool enabled(const Protection::Region& region) { return mpu::RASR_ENABLE.of(region.attributes) != 0; }

bool no_access(const Protection::Region& region) { return mpu::RASR_AP.of(region.attributes) == 0; }

Protection::Access access(const Protection::Region& region) {
  const std::uint32_t permission = mpu::RASR_AP.of(region.attributes);
  const bool read = permission != 0, write = permission >= 1 && permission <= 3;
  const bool cached = mpu::RASR_C.of(region.attributes) != 0 || mpu::RASR_B.of(region.attributes) != 0;
  return {read, write, read && mpu::RASR_XN.of(region.attributes) == 0, cached};
}

/// In the default memory map normal memory is cached, write-back or write-through.
bool cached_by_default(std::uint32_t address) {
  return address < 0x4000'0000 || (address >= 0x6000'0000 && address < 0xA000'0000);
}

}  // namespace

std::uint64_t Protection::Region::bytes() const { return std::uint64_t{2} << mpu::RASR_SIZE.of(attributes); }

void Protection::reset() {
  regions_ = {};
  selected_ = 0;
  on_ = background_ = false;
  changed_();
}

/// Every region from number 8 on forbids something that a program needs, so a program must remove all of
/// them.
void Protection::leave_rom_state() {
  constexpr std::uint32_t kAll = mpu::RASR_AP(3), kNone = mpu::RASR_AP(0), kReadOnly = mpu::RASR_AP(7);
  constexpr std::uint32_t kNoCode = mpu::RASR_XN(1);
  const auto region = [](std::uint32_t base, std::uint32_t size_log2, std::uint32_t attributes) {
    return Region{base, attributes | mpu::RASR_SIZE(size_log2 - 1) | mpu::RASR_ENABLE(1)};
  };
  regions_ = {};
  regions_[0] = region(0, 32, kAll);
  regions_[8] = region(Memory::kItcm, 17, kNone);
  regions_[9] = region(Memory::kDtcm, 19, kNone);
  regions_[10] = region(0x4000'0000, 26, kNone);  // peripherals
  regions_[11] = region(Memory::kFlash + 0x1F'0000, 16, kNone);
  regions_[12] = region(Memory::kItcm, 15, kAll | kNoCode);
  regions_[13] = region(Memory::kDtcm, 15, kReadOnly);
  regions_[14] = region(Memory::kDtcm, 12, kNone);
  regions_[15] = region(Memory::kItcm, 10, kNone);
  on_ = true;
  background_ = false;
  changed_();
}

Protection::Access Protection::at(std::uint32_t address, std::uint64_t smallest) const {
  if (!on_) return {.cached = cached_by_default(address)};
  for (std::size_t number = regions_.size(); number-- > 0;) {
    const Region& region = regions_[number];
    if (enabled(region) && region.bytes() >= smallest && address >= region.base &&
        address - region.base < region.bytes())
      return access(region);
  }
  return {background_, background_, background_, background_ && cached_by_default(address)};
}

std::vector<Protection::Span> Protection::traps() const {
  std::vector<Span> found;
  for (const Region& region : regions_)
    if (on_ && enabled(region) && region.bytes() < kPage)
      found.push_back({region.base, static_cast<std::uint32_t>(region.bytes())});
  return found;
}

std::vector<std::uint64_t> Protection::edges() const {
  std::vector<std::uint64_t> found;
  for (const Region& region : regions_)
    if (on_ && enabled(region) && region.bytes() >= kPage)
      found.insert(found.end(), {region.base, region.base + region.bytes()});
  return found;
}

std::uint32_t Protection::read(std::uint32_t offset) const {
  if (offset == mpu::TYPE.value) return static_cast<std::uint32_t>(regions_.size()) << 8;
  if (offset == mpu::CTRL.value) return mpu::CTRL_ENABLE(on_) | (background_ ? kPrivilegedDefault : 0);
  if (offset == mpu::RNR.value) return static_cast<std::uint32_t>(selected_);
  if (offset == mpu::RBAR.value) return regions_[selected_].base | static_cast<std::uint32_t>(selected_);
  return regions_[selected_].attributes;
}

void Protection::set_attributes(std::uint32_t value) {
  Region& region = regions_[selected_];
  region.attributes = value;
  if (!enabled(region)) return;
  if (region.bytes() < 32)
    machine_.fail({"MPU RASR: a region has at least 32 bytes", RegionProblem::too_small});
  if (region.base % region.bytes() != 0)
    machine_.fail(
        {"MPU RASR: the region does not begin at a multiple of its size", RegionProblem::misaligned});
  if ((value & kSubregions) != 0)
    machine_.fail({"MPU RASR: subregions are not modelled", RegionProblem::subregions});
  if (region.bytes() < kPage && !no_access(region))
    machine_.fail({"MPU RASR: a region below 1 KB that gives some access is not modelled",
                   RegionProblem::small_with_access});
}

void Protection::write(std::uint32_t offset, std::uint32_t value) {
  const bool was_on = on_;
  if (offset == mpu::CTRL.value) {
    on_ = mpu::CTRL_ENABLE.of(value) != 0;
    background_ = (value & kPrivilegedDefault) != 0;
  } else if (offset == mpu::RNR.value) {
    selected_ = value % regions_.size();
  } else if (on_) {
    machine_.fail({"MPU: a region is programmed while the MPU is on (CTRL.ENABLE)", RegionProblem::mpu_on});
  } else if (offset == mpu::RBAR.value) {
    if (mpu::RBAR_VALID.of(value) != 0) selected_ = mpu::RBAR_REGION.of(value);
    regions_[selected_].base = value & ~0x1FU;
  } else if (offset == mpu::RASR.value) {
    set_attributes(value);
  }
  if (on_ || was_on) changed_();
}

}  // namespace astro::emulator
