#include <gtest/gtest.h>

#include "firmware/app/robot.hpp"
#include "hal/mock/board.hpp"

namespace astro {
namespace {

class Watchdog : public testing::Test {
 protected:
  int feeds() { return board_.system().watchdog_feeds; }
  mock::Board board_;
  Robot<mock::Board> robot_{board_};
};

TEST_F(Watchdog, IsFedWhileTickAndMainLoopGoRound) {
  for (int i = 0; i < 10; ++i) {
    robot_.tick();
    robot_.poll();
  }
  EXPECT_EQ(feeds(), 10);
}

TEST_F(Watchdog, IsNotFedByAMainLoopWithoutTicks) {
  for (int i = 0; i < 100; ++i) robot_.poll();
  EXPECT_EQ(feeds(), 0);
  robot_.tick();
  for (int i = 0; i < 100; ++i) robot_.poll();
  EXPECT_EQ(feeds(), 1) << "one tick is one sign of life";
}

TEST_F(Watchdog, IsNotFedByTicksWithoutAMainLoop) {
  for (int i = 0; i < 100; ++i) robot_.tick();
  EXPECT_EQ(feeds(), 0);
}

TEST(CheckIn, IsCompleteOnlyWithEveryTaskAndThenBeginsAgain) {
  using Task = CheckIn::Task;
  for (const Task missing : {Task::tick, Task::supervisor, Task::link}) {
    CheckIn check_in;
    for (const Task task : {Task::tick, Task::supervisor, Task::link})
      if (task != missing) check_in.here(task);
    EXPECT_FALSE(check_in.complete());
    check_in.here(missing);
    EXPECT_TRUE(check_in.complete());
    EXPECT_FALSE(check_in.complete());
  }
}

class BootloaderPastTheProtocol : public Watchdog {
 protected:
  static std::vector<std::uint8_t> frame(const auto& message) {
    std::array<std::uint8_t, protocol::kMaxBody> body{};
    std::array<std::uint8_t, protocol::kMaxFrame> out{};
    const std::size_t size = protocol::encode(message, 1, body);
    const auto framed = std::span(out).first(protocol::encode_frame(std::span(body).first(size), out));
    return {framed.begin(), framed.end()};
  }
  void send(const std::vector<std::uint8_t>& bytes) {
    auto& waiting = board_.ports().lanes[0].to_robot;
    waiting.insert(waiting.end(), bytes.begin(), bytes.end());
  }
  BootloaderPastTheProtocol() { run_ms(50); }  // through boot
  void run_ms(int ms) {
    for (int i = 0; i < ms; ++i) {
      board_.clock().time_us += 1000;
      robot_.tick();
      robot_.poll();
    }
  }
  bool armed() {
    const auto hold = board_.hold_tick();
    return robot_.drive(hold).armed();
  }
  void ask_and_wait() {
    board_.system().bootloader_wanted = true;
    run_ms(100);
  }
};

TEST_F(BootloaderPastTheProtocol, IsEnteredByADisarmedRobot) {
  ask_and_wait();
  EXPECT_EQ(board_.system().bootloader_entries, 1);
}

TEST_F(BootloaderPastTheProtocol, IsRefusedByAnArmedOneAndNotGrantedLater) {
  send(frame(protocol::Arm{}));
  robot_.poll();
  ASSERT_TRUE(armed());
  ask_and_wait();
  EXPECT_EQ(board_.system().bootloader_entries, 0);
  send(frame(protocol::Disarm{}));
  ask_and_wait();
  EXPECT_EQ(board_.system().bootloader_entries, 1) << "asked again, disarmed";
}

TEST_F(BootloaderPastTheProtocol, ARobotThatIsAboutToEnterItIsDisarmedAndArmsNoMore) {
  send(frame(protocol::Arm{}));
  robot_.poll();
  send(frame(protocol::EnterBootloader{}));
  robot_.poll();
  EXPECT_FALSE(armed());
  send(frame(protocol::Arm{}));
  robot_.poll();
  EXPECT_FALSE(armed());
  EXPECT_EQ(board_.system().bootloader_entries, 0) << "the answer has to leave first";
}

}  // namespace
}  // namespace astro
