#include "hal/sim/flash.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace astro::sim {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes content(const Flash& flash) { return {flash.content().begin(), flash.content().end()}; }

TEST(Flash, IsBlankUnlessGivenAnImage) {
  EXPECT_EQ(content(Flash()), Bytes(Flash::kBytes, 0xFF));
  const Flash loaded(Bytes{1, 2, 3});
  EXPECT_EQ(loaded.content()[2], 3);
  EXPECT_EQ(loaded.content()[3], 0xFF);
}

TEST(Flash, ContentGoesThroughSaveAndLoad) {
  Flash flash;
  ASSERT_TRUE(flash.program(4096 + 8, Bytes{1, 2, 3, 4}));
  EXPECT_EQ(content(Flash(content(flash))), content(flash));
}

TEST(Flash, MisuseIsRefusedAndChangesNothing) {
  Flash flash;
  const Bytes word(4, 0);
  EXPECT_FALSE(flash.program(2, word)) << "unaligned";
  EXPECT_FALSE(flash.program(0, Bytes(3, 0))) << "size not a multiple of the grain";
  EXPECT_FALSE(flash.program(4092, Bytes(8, 0))) << "across a sector's end";
  EXPECT_FALSE(flash.program(Flash::kBytes, word)) << "beyond the part";
  EXPECT_FALSE(flash.program(0xFFFF'FFFC, word)) << "far beyond the part";
  EXPECT_FALSE(flash.erase(Flash::kSectors));
  EXPECT_EQ(content(flash), Bytes(Flash::kBytes, 0xFF));
  EXPECT_EQ(flash.misuses(), 6);
  Bytes into(8, 0);
  flash.read(Flash::kBytes - 4, into);
  EXPECT_EQ(into, Bytes(8, 0xFF));
}

// All cuts, in both styles: bytes before the cut are new, bytes after it old (or, torn, a mixture bit by
// bit), bytes outside the call untouched, and nothing works before power returns.
TEST(Flash, PowerCutAfterAnyByteOfAProgramKeepsToTheContract) {
  const Bytes old_bytes = {0xF0, 0x0F, 0xFF, 0xAA, 0x55, 0xFF, 0xFF, 0x3C};
  const Bytes written = {0x90, 0x0A, 0x12, 0x88, 0x11, 0x00, 0xFE, 0x24};
  for (const Tear tear : {Tear::sharp, Tear::torn}) {
    for (std::size_t cut = 0; cut <= written.size(); ++cut) {
      Flash flash;
      ASSERT_TRUE(flash.program(16, old_bytes));
      flash.cut_power_after(cut, tear);
      ASSERT_FALSE(flash.program(16, written)) << cut;
      for (std::size_t i = 0; i < written.size(); ++i) {
        const std::uint8_t now = flash.content()[16 + i];
        if (i < cut) {
          EXPECT_EQ(now, written[i]);
        } else if (tear == Tear::sharp) {
          EXPECT_EQ(now, old_bytes[i]);
        } else {
          EXPECT_EQ(now & ~old_bytes[i], 0) << "no bit that was clear is set";
          EXPECT_EQ(~now & written[i], 0) << "no bit is cleared that nobody asked for";
        }
      }
      EXPECT_TRUE(
          std::all_of(flash.content().begin() + 24, flash.content().end(), [](auto b) { return b == 0xFF; }));
      const Bytes before = content(flash);
      EXPECT_FALSE(flash.powered());
      EXPECT_FALSE(flash.erase(0));
      EXPECT_FALSE(flash.program(32, Bytes(4, 0)));
      EXPECT_EQ(content(flash), before);
      flash.restore_power();
      EXPECT_TRUE(flash.erase(0));
    }
  }
}

TEST(Flash, PowerCutInAnEraseLeavesPartOfTheSector) {
  Flash flash;
  ASSERT_TRUE(flash.program(4096, Bytes(4096, 0x00)));
  flash.cut_power_after(1000);
  EXPECT_FALSE(flash.erase(1));
  EXPECT_EQ(std::count(flash.content().begin() + 4096, flash.content().begin() + 8192, 0xFF), 1000);
  EXPECT_EQ(flash.content()[4096 + 999], 0xFF);
  EXPECT_EQ(flash.content()[4096 + 1000], 0x00);
}

TEST(Flash, TornProgramMixesBits) {
  Flash flash;
  flash.cut_power_after(0, Tear::torn);
  EXPECT_FALSE(flash.program(0, Bytes(4096, 0x00)));
  const auto sector = flash.content().first<4096>();
  EXPECT_GT(std::count_if(sector.begin(), sector.end(), [](auto b) { return b != 0x00 && b != 0xFF; }), 3000);
}

TEST(Flash, TornEraseMixesBits) {
  Flash flash;
  ASSERT_TRUE(flash.program(0, Bytes(4096, 0x00)));
  flash.cut_power_after(0, Tear::torn);
  EXPECT_FALSE(flash.erase(0));
  const auto sector = flash.content().first<4096>();
  EXPECT_GT(std::count_if(sector.begin(), sector.end(), [](auto b) { return b != 0x00 && b != 0xFF; }), 3000);
  EXPECT_TRUE(
      std::all_of(flash.content().begin() + 4096, flash.content().end(), [](auto b) { return b == 0xFF; }));
}

TEST(Flash, ACutInAByteMixesThatByteAndNoOther) {
  Flash flash;
  flash.cut_power_after(1000, Tear::byte, 3);
  EXPECT_FALSE(flash.program(0, Bytes(4096, 0x00)));
  EXPECT_EQ(std::count(flash.content().begin(), flash.content().end(), 0x00), 1000);
  EXPECT_EQ(std::count(flash.content().begin() + 1001, flash.content().end(), 0xFF), Flash::kBytes - 1001);
}

TEST(Flash, TornBitsAreAFunctionOfSeedPlaceAndAddressWhateverWentBefore) {
  const auto torn = [](std::uint64_t seed, int programs_before) {
    Flash flash;
    for (int i = 0; i < programs_before; ++i) EXPECT_TRUE(flash.program(4096, Bytes(4, 0xFF)));
    flash.cut_power_after(100, Tear::torn, seed);
    EXPECT_FALSE(flash.program(0, Bytes(4096, 0x00)));
    return content(flash);
  };
  EXPECT_EQ(torn(1, 0), torn(1, 5));
  EXPECT_NE(torn(1, 0), torn(2, 0));
}

TEST(Flash, RotTurnsBitsOver) {
  Flash flash;
  flash.rot(7, 0x81);
  EXPECT_EQ(flash.content()[7], 0x7E);
  flash.rot(7, 0x01);
  EXPECT_EQ(flash.content()[7], 0x7F);
  EXPECT_TRUE(flash.erase(0)) << "and an erase puts it right";
}

TEST(Flash, ACellThatSticksHoldsItsLevelWhateverIsDone) {
  Flash low, high;
  low.stick(5, 0x10, false);
  EXPECT_EQ(low.content()[5], 0xEF);
  EXPECT_FALSE(low.erase(0)) << "which does not read back";
  EXPECT_EQ(low.content()[5], 0xEF);
  high.stick(5, 0x10, true);
  EXPECT_FALSE(high.program(4, Bytes(4, 0x00)));
  EXPECT_EQ(high.content()[5], 0x10);
  EXPECT_TRUE(high.erase(0));
  EXPECT_TRUE(high.program(4, Bytes(4, 0x10))) << "and nobody notices who wants what it has";
  high.rot(5, 0x10);
  EXPECT_EQ(high.content()[5], 0x10);
}

TEST(Flash, AFailingSectorStaysAsItIsAndItsNeighboursWork) {
  for (const FlashWork kind : {FlashWork::erase, FlashWork::program}) {
    Flash flash;
    for (std::uint32_t at = 0; at < Flash::kBytes; at += 4096) ASSERT_TRUE(flash.program(at, Bytes(8, 0x0F)));
    flash.fail(1, kind);
    const bool erases = kind != FlashWork::erase;
    EXPECT_EQ(flash.erase(1), erases);
    EXPECT_EQ(flash.program(4096, Bytes(4, 0x00)), !erases);
    EXPECT_EQ(flash.content()[4096 + 7], erases ? 0xFF : 0x0F);
    EXPECT_TRUE(flash.program(8192, Bytes(4, 0x00)));
    EXPECT_TRUE(flash.erase(0));
    EXPECT_EQ(flash.erases(1), 1U) << "wear counts work that does not take";
  }
}

TEST(Flash, WorkIsCountedInBytes) {
  Flash flash;
  ASSERT_TRUE(flash.program(0, Bytes(12, 0)));
  ASSERT_TRUE(flash.erase(2));
  EXPECT_EQ(flash.bytes_worked(), 12U + 4096U);
}

}  // namespace
}  // namespace astro::sim
