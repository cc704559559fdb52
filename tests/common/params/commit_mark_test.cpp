#include "common/params/commit_mark.hpp"

#include <gtest/gtest.h>

#include "hal/sim/flash.hpp"

/// A number that outlives the loss of any one sector, and never claims more than it was told.
namespace astro {
namespace {

using Flash = sim::SimulatedFlash<2, 4096, 8>;
using Mark = CommitMark<Flash, 64, 40>;

TEST(CommitMark, OfABlankFlashIsNone) {
  Flash flash;
  EXPECT_FALSE(Mark(flash).newest());
  Mark(flash).refresh();
  EXPECT_EQ(flash.bytes_worked(), 0U);
}

TEST(CommitMark, KnowsTheGreatestNumberAlsoAcrossTheWrap) {
  Flash flash;
  for (const std::uint32_t number : {0U, 1U, 17U, 0x7FFF'0000U, 0xFFFE'0000U, 0xFFFF'FFFEU, 0U, 5U}) {
    Mark(flash).raise(number);
    EXPECT_EQ(Mark(flash).newest(), number);
  }
  Mark(flash).raise(3);
  EXPECT_EQ(Mark(flash).newest(), 5U) << "it only grows";
  EXPECT_EQ(flash.misuses(), 0);
}

// The CRC-32 of four bytes of 0xFF is 0xFFFFFFFF: that number would look like erased flash.
TEST(CommitMark, StaysBehindForTheOneNumberThatLooksLikeErasedFlash) {
  Flash flash;
  Mark(flash).raise(0xFFFF'FFFEU);
  Mark(flash).raise(0xFFFF'FFFFU);
  EXPECT_EQ(Mark(flash).newest(), 0xFFFF'FFFEU);
  Mark(flash).raise(0);
  EXPECT_EQ(Mark(flash).newest(), 0U);
}

TEST(CommitMark, OutlivesAnErasedSectorAndComesBackIntoIt) {
  for (const std::uint32_t gone : {0U, 1U}) {
    Flash flash;
    Mark(flash).raise(41);
    Mark(flash).raise(42);
    flash.erase(gone);
    EXPECT_EQ(Mark(flash).newest(), 42U);
    Mark(flash).refresh();
    flash.erase(1 - gone);
    EXPECT_EQ(Mark(flash).newest(), 42U);
  }
}

TEST(CommitMark, LeavesTheEntriesOfTheSlotsAlone) {
  Flash flash;
  for (std::uint32_t number = 0; number < 1000; ++number) Mark(flash).raise(number);
  for (std::uint32_t at = 0; at < Flash::kBytes; ++at)
    ASSERT_TRUE(at % 64 >= 40 || flash.content()[at] == 0xFF) << at;
  EXPECT_EQ(Mark::kInSector, 192U);
  EXPECT_EQ(Mark(flash).newest(), 191U) << "without a place left it stays behind";
  flash.erase(0);
  Mark(flash).raise(1000);
  EXPECT_EQ(Mark(flash).newest(), 1000U);
}

TEST(CommitMark, APowerCutAtAnyByteLeavesTheOldNumberOrTheNewOne) {
  int old_numbers = 0, new_numbers = 0;
  for (const sim::Tear tear : {sim::Tear::sharp, sim::Tear::byte, sim::Tear::torn})
    for (std::uint64_t cut = 0; cut <= 16; ++cut) {
      Flash flash;
      Mark(flash).raise(0x0102'0304);
      flash.cut_power_after(cut, tear, cut);
      Mark(flash).raise(0x0102'0305);
      flash.restore_power();
      const auto found = Mark(flash).newest();
      ASSERT_TRUE(found == 0x0102'0304U || found == 0x0102'0305U) << "cut after " << cut;
      ++(found == 0x0102'0304U ? old_numbers : new_numbers);
      Mark(flash).raise(0x0102'0306);
      ASSERT_EQ(Mark(flash).newest(), 0x0102'0306U) << "and it goes on behind the torn one";
    }
  EXPECT_GT(old_numbers, 0);
  EXPECT_GT(new_numbers, 0);
}

TEST(CommitMark, PassesOverAPlaceThatDoesNotTakeIt) {
  Flash flash;
  flash.stick(40, 0x01, true);
  flash.stick(4096 + 48, 0x80, false);
  for (const std::uint32_t number : {0U, 2U, 0x8000'0000U - 1}) {
    Mark(flash).raise(number);
    for (const std::uint32_t gone : {0U, 1U}) {
      Flash rest;
      rest.put_back(0, flash.content());
      rest.erase(gone);
      EXPECT_EQ(Mark(rest).newest(), number);
    }
  }
}

}  // namespace
}  // namespace astro
