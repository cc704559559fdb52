#include <gtest/gtest.h>

#include <algorithm>

#include "tests/target/contract/teensy_rig.hpp"

// What no other board has: a cache before its flash, a clock in two halves.
namespace astro::target {
namespace {

TEST(TeensyFlash, IsReadWhereItWasNotErasedAsItWasBefore) {
  Puppet puppet(1);
  TeensyBoard board(puppet);
  std::array<std::uint8_t, 8> bytes{1, 2, 3, 4, 5, 6, 7, 8}, read{};
  for (std::uint32_t sector = 0; sector < TeensyBoard::Flash::kSectors; ++sector)
    ASSERT_TRUE(board.flash().erase(sector));
  for (std::uint32_t sector = 0; sector + 1 < TeensyBoard::Flash::kSectors; ++sector) {
    const std::uint32_t offset = sector * TeensyBoard::Flash::kSectorBytes;
    ASSERT_TRUE(board.flash().program(offset, bytes));
    ASSERT_TRUE(board.flash().erase(sector + 1));
    for (std::uint32_t other = 0; other < TeensyBoard::Flash::kSectors;
         ++other)  // a board's read may not throw
      ASSERT_NO_THROW(puppet.call(Call::read_flash, other * TeensyBoard::Flash::kSectorBytes, 8));
    board.flash().read(offset, read);
    EXPECT_EQ(read, bytes);
  }
}

TEST(TeensyClock, DoesNotGoBackWhenItsLowerHalfBeginsAnew) {
  constexpr std::uint64_t kLowerHalf = std::uint64_t{1} << 32;  // counts of 24 MHz, 25 cycles each
  constexpr std::uint64_t kPerMicrosecond = 24;
  Puppet puppet(1);
  emulator::Pit& timers = puppet.teensy().timers();
  std::uint64_t last_us = puppet.call(Call::now_us);
  // Ever later, by a fifth of a count, within the 4 us in which the processor finds the call and reads the
  // clock.
  for (std::uint64_t left = 1; left < 4 * kPerMicrosecond; ++left)
    for (emulator::Cycles cycles = 0; cycles < 25; cycles += 5) {
      SCOPED_TRACE(left);
      const std::uint64_t now_counts = timers.lifetime_us() * kPerMicrosecond;
      timers.age(kLowerHalf - now_counts % kLowerHalf - left);
      puppet.teensy().chip().wait(cycles);
      const std::uint64_t now_us = puppet.call(Call::now_us);
      ASSERT_GE(now_us, last_us);
      ASSERT_LE(timers.lifetime_us() - now_us, 50U);
      last_us = now_us;
    }
}

}  // namespace
}  // namespace astro::target
