#include <gtest/gtest.h>

#include "tests/target/contract/teensy_rig.hpp"

// What no other board has: a cache before its flash.
namespace astro::target {
namespace {

TEST(TeensyFlash, IsReadWhereItWasNotErasedAsItWasBefore) {
  Puppet puppet(1);
  RemoteBoard board(puppet);
  std::array<std::uint8_t, 8> bytes{1, 2, 3, 4, 5, 6, 7, 8}, read{};
  for (std::uint32_t sector = 0; sector < RemoteBoard::Flash::kSectors; ++sector)
    ASSERT_TRUE(board.flash().erase(sector));
  for (std::uint32_t sector = 0; sector + 1 < RemoteBoard::Flash::kSectors; ++sector) {
    const std::uint32_t offset = sector * RemoteBoard::Flash::kSectorBytes;
    ASSERT_TRUE(board.flash().program(offset, bytes));
    ASSERT_TRUE(board.flash().erase(sector + 1));
    for (std::uint32_t other = 0; other < RemoteBoard::Flash::kSectors;
         ++other)  // a board's read may not throw
      ASSERT_NO_THROW(puppet.call(Call::read_flash, other * RemoteBoard::Flash::kSectorBytes, 8));
    board.flash().read(offset, read);
    EXPECT_EQ(read, bytes);
  }
}

}  // namespace
}  // namespace astro::target
