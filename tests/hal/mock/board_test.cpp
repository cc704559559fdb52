#include "hal/mock/board.hpp"

#include <gtest/gtest.h>

namespace astro::mock {
namespace {

TEST(MockBoard, TimeStandsStillUntilTheTestMovesIt) {
  Board board;
  EXPECT_EQ(board.clock().now_us(), 0U);
  board.clock().time_us += 250;
  EXPECT_EQ(board.clock().now_us(), 250U);
}

TEST(MockBoard, RemembersWhatTheMotorsWereTold) {
  Board board;
  board.motors().drive({5, -6});
  board.motors().drive({7, -8});
  board.motors().coast();
  EXPECT_EQ(board.motors().state, Bridge::coast);
  EXPECT_EQ(board.motors().duty, (hal::Duty{7, -8})) << "the last duty stays readable";
  EXPECT_EQ(board.motors().drives, 2);
  EXPECT_EQ(board.motors().coasts, 1);
  EXPECT_EQ(board.motors().brakes, 0);
}

TEST(MockBoard, CountsResetsAndFeeds) {
  Board board;
  board.system().reboot();
  board.system().feed_watchdog();
  board.system().feed_watchdog();
  EXPECT_EQ(board.system().reboots, 1);
  EXPECT_EQ(board.system().watchdog_feeds, 2);
  EXPECT_EQ(board.motors().coasts, 1) << "a reboot coasts";
  board.system().has_bootloader = false;
  EXPECT_FALSE(board.system().enter_bootloader());
  EXPECT_EQ(board.system().bootloader_entries, 0);
}

TEST(MockBoard, TellsWhetherTheTickIsHeld) {
  Board board;
  EXPECT_FALSE(board.tick_is_held());
  {
    const auto outer = board.hold_tick();
    const auto inner = board.hold_tick();
    EXPECT_TRUE(board.tick_is_held());
  }
  EXPECT_FALSE(board.tick_is_held());
}

TEST(MockBoard, LazyHostLeavesOnlySoMuchRoom) {
  Board board;
  board.ports().lane(1).capacity = 3;
  EXPECT_EQ(board.ports().room(1), 3U);
  EXPECT_EQ(board.ports().write(1, std::array<std::uint8_t, 5>{1, 2, 3, 4, 5}), 3U);
  EXPECT_EQ(board.ports().lane(1).to_host, (std::vector<std::uint8_t>{1, 2, 3}));
}

TEST(MockFlash, RefusesMisuseAndBreaksOnDemand) {
  Flash flash;
  const std::array<std::uint8_t, 8> grain{};
  EXPECT_FALSE(flash.program(4, grain)) << "unaligned";
  EXPECT_FALSE(flash.program(4 * 4096, grain)) << "beyond the part";
  EXPECT_FALSE(flash.program(0, std::span(grain).first(4))) << "less than a grain";
  EXPECT_FALSE(flash.erase(4));
  flash.broken = true;
  EXPECT_FALSE(flash.erase(0));
  EXPECT_FALSE(flash.program(0, grain));
  EXPECT_EQ(flash.content[0], 0xFF);
}

}  // namespace
}  // namespace astro::mock
