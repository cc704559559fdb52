#include "hal/teensy40/core/protection.hpp"

#include <array>
#include <cstdint>

#include "hal/teensy40/core/cpu.hpp"
#include "hal/teensy40/registers/registers.hpp"

namespace astro::teensy40::protection {
namespace {

constexpr std::uint32_t kDevice = mpu::RASR_TEX(2);
constexpr std::uint32_t kNoCache = mpu::RASR_TEX(1);
constexpr std::uint32_t kWriteThrough = mpu::RASR_C(1);
constexpr std::uint32_t kWriteBack = mpu::RASR_TEX(1) | mpu::RASR_C(1) | mpu::RASR_B(1);
constexpr std::uint32_t kNoAccess = mpu::RASR_AP(0), kAll = mpu::RASR_AP(3), kReadOnly = mpu::RASR_AP(7);
constexpr std::uint32_t kNoCode = mpu::RASR_XN(1);

struct Region {
  std::uint32_t base;
  int size_log2;
  std::uint32_t attributes;
};

/// Where two regions overlap the later one applies.
constexpr std::array<Region, 8> kRegions{{
    {0x0000'0000, 32, kNoAccess | kNoCode},          // everything else, also for speculative reads
    {0x0000'0000, 17, kReadOnly | kNoCache},         // ITCM: code and constants
    {0x0000'0000, 5, kNoAccess | kNoCode},           // null
    {0x0020'0000, 17, kReadOnly | kWriteThrough},    // boot ROM
    {0x2000'0000, 19, kAll | kNoCache | kNoCode},    // DTCM; below it lies nothing, and the stack ends there
    {0x2020'0000, 19, kAll | kWriteBack | kNoCode},  // OCRAM
    {0x4000'0000, 26, kAll | kDevice | kNoCode},     // peripherals
    {0x6000'0000, 21, kReadOnly | kWriteBack | kNoCode},  // flash: nothing runs there after start-up
}};

void set(std::uint32_t number, const Region& region) {
  MPU[mpu::RBAR].write(region.base | mpu::RBAR_REGION(number) | mpu::RBAR_VALID(1));
  MPU[mpu::RASR].write(region.attributes | mpu::RASR_SIZE(static_cast<std::uint32_t>(region.size_log2) - 1) |
                       mpu::RASR_ENABLE(1));
}

/// The MPU has 16 regions, and a higher one takes precedence: one that the ROM has left would override ours.
void clear(std::uint32_t number) {
  MPU[mpu::RNR].write(number);
  MPU[mpu::RASR].write(0);
}

/// Invalidates 4 ways of 256 lines of 32 bytes: after power-on their state is undefined, and a restart keeps
/// the lines of the program before.
void forget_data_cache() {
  for (std::uint32_t way = 0; way < 4; ++way)
    for (std::uint32_t line = 0; line < 256; ++line) SCB[scb::DCISW].write(way << 30 | line << 5);
  cpu::synchronize();
}

}  // namespace

/// Precondition: the MPU is off (reset() does that), because regions must not change while they are in force.
void start() {
  constexpr std::uint32_t kAllRegions = 16;
  for (std::uint32_t number = 0; number < kAllRegions; ++number) clear(number);
  for (std::uint32_t number = 0; number < kRegions.size(); ++number) set(number, kRegions[number]);
  MPU[mpu::CTRL].write(mpu::CTRL_ENABLE(1));
  cpu::synchronize();
  cpu::refetch();
  SCB[scb::ICIALLU].write(0);
  cpu::synchronize();
  cpu::refetch();
  forget_data_cache();
  SCB[scb::CCR].modify(0, scb::CCR_IC(1) | scb::CCR_DC(1));
  cpu::synchronize();
  cpu::refetch();
}

}  // namespace astro::teensy40::protection
