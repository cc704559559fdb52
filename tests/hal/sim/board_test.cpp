#include "hal/sim/board.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <vector>

#include "tests/hal/sim/support.hpp"

namespace astro::sim {
namespace {

// Everything that a run leaves behind, as bits.
std::vector<std::uint64_t> trace(const Config& config) {
  Board board(config);
  std::vector<std::uint64_t> bits;
  for (int part = 0; part < 3; ++part) {
    eventful_drive(board);
    const hal::EncoderCounts counts = board.encoders().read();
    for (const double value : {board.truth().x_m, board.truth().y_m, board.truth().theta_rad})
      bits.push_back(std::bit_cast<std::uint64_t>(value));
    bits.push_back(static_cast<std::uint32_t>(counts.left));
    bits.push_back(static_cast<std::uint32_t>(counts.right));
    bits.push_back(static_cast<std::uint64_t>(board.battery().millivolts()));
  }
  return bits;
}

TEST(Board, SameSeedGivesTheSameBits) { EXPECT_EQ(trace(Config{}), trace(Config{})); }

TEST(Board, OtherSeedSlipsDifferentlyButCountsTheSame) {
  Config other;
  other.seed = 2;
  const std::vector<std::uint64_t> first = trace(Config{}), second = trace(other);
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (i % 6 < 3) {
      EXPECT_NE(first[i], second[i]) << "truth, entry " << i;
    } else {
      EXPECT_EQ(first[i], second[i]) << "noise is on the ground, not in the motors; entry " << i;
    }
  }
}

TEST(Board, BoardsDoNotShareState) {
  Board one(Config{}), two(Config{});
  for (int ms = 0; ms < 500; ++ms) {  // interleaved, only one of them driving
    one.motors().drive({12000, 14000});
    one.advance_tick();
    two.advance_tick();
  }
  EXPECT_GT(one.encoders().read().left, 0);
  EXPECT_EQ(two.encoders().read().left, 0);
  EXPECT_EQ(two.truth().x_m, 0.0);
}

TEST(Board, StandKeepsTheBodyInPlace) {
  Board board(on_stand());
  board.motors().drive({20000, 10000});
  run_ms(board, 1000);
  EXPECT_GT(board.encoders().read().left, 1000);
  EXPECT_EQ(board.truth().x_m, 0.0);
  EXPECT_EQ(board.truth().theta_rad, 0.0);
}

TEST(Board, RestartResetsTheProcessorAndNotTheWorld) {
  Board board(Config{});
  ASSERT_TRUE(board.flash().program(0, std::vector<std::uint8_t>(4, 0x11)));
  ASSERT_EQ(board.ports().host_write(0, std::vector<std::uint8_t>(9)), 9U);
  board.motors().drive({20000, 20000});
  run_ms(board, 500);
  const double x_m = board.truth().x_m;
  board.restart(hal::ResetCause::watchdog);
  EXPECT_EQ(board.clock().now_us(), 0U);
  EXPECT_EQ(board.encoders().read().left, 0);
  EXPECT_EQ(board.motors().state(), Bridge::coast);
  EXPECT_EQ(board.system().reset_cause(), hal::ResetCause::watchdog);
  EXPECT_EQ(board.ports().host_room(0), ByteQueue::kCapacity);
  EXPECT_EQ(board.flash().content()[0], 0x11);
  EXPECT_EQ(board.truth().x_m, x_m);
  EXPECT_EQ(board.world_us(), 500'000U);
  board.advance_tick();
  EXPECT_GT(board.truth().x_m, x_m) << "the robot rolls on while its processor starts";
}

TEST(Board, RequestsAreTakenOnce) {
  Board board(Config{});
  EXPECT_FALSE(board.system().take_reboot_request());
  board.system().reboot();
  EXPECT_TRUE(board.system().take_reboot_request());
  EXPECT_FALSE(board.system().take_reboot_request());
  EXPECT_TRUE(board.system().enter_bootloader());
  EXPECT_TRUE(board.system().take_bootloader_request());
  EXPECT_FALSE(board.system().take_bootloader_request());
}

TEST(Board, WatchdogHungerGrowsUntilFed) {
  Board board(Config{});
  run_ms(board, 30);
  EXPECT_EQ(board.system().since_fed_us(), 30'000U);
  board.system().feed_watchdog();
  EXPECT_EQ(board.system().since_fed_us(), 0U);
}

TEST(Board, PlacedRobotDrivesOnFromThere) {
  Board board(ideal());
  board.place({1.0, 2.0, std::acos(0.0)});
  board.motors().drive({15000, 15000});
  run_ms(board, 1000);
  EXPECT_NEAR(board.truth().x_m, 1.0, 1e-12) << "facing along y";
  EXPECT_GT(board.truth().y_m, 2.2);
}

TEST(ByteQueue, KeepsOrderAcrossItsSeam) {
  ByteQueue queue;
  std::uint8_t next_in = 0, next_out = 0;
  std::vector<std::uint8_t> chunk(1000);
  for (int round = 0; round < 100; ++round) {
    for (std::uint8_t& byte : chunk) byte = next_in++;
    ASSERT_EQ(queue.push(chunk), chunk.size());
    ASSERT_EQ(queue.pop(chunk), chunk.size());
    for (const std::uint8_t byte : chunk) ASSERT_EQ(byte, next_out++);
  }
}

}  // namespace
}  // namespace astro::sim
