#include <gtest/gtest.h>

#include "common/protocol/frame.hpp"
#include "common/protocol/framer.hpp"
#include "firmware/app/robot.hpp"
#include "hal/mock/board.hpp"

// The rate of telemetry from a main loop that is sometimes late.
namespace astro {
namespace {

class TelemetryRate : public testing::Test {
 protected:
  TelemetryRate() {
    board_.ports().lane(0).capacity = std::size_t{1} << 20;
    run(10, 1);
  }

  void ask_for_every(std::uint16_t period_ms) {
    const protocol::Frame frame(protocol::SetTelemetry{period_ms, protocol::Telemetry::kBattery}, ++request_);
    auto& waiting = board_.ports().lane(0).to_robot;
    waiting.insert(waiting.end(), frame.bytes().begin(), frame.bytes().end());
    robot_.poll();
    board_.ports().lane(0).to_host.clear();
  }

  /// Ticks on time, and a main loop that goes round once in `turn_ms`.
  void run(int ms, int turn_ms) {
    for (int i = 1; i <= ms; ++i) {
      board_.clock().time_us += 1000;
      robot_.tick();
      if (i % turn_ms == 0) robot_.poll();
    }
  }

  /// Telemetry since the last call.
  int frames() {
    protocol::Framer framer;
    int count = 0;
    for (const std::uint8_t byte : board_.ports().lane(0).to_host)
      if (const auto body = framer.push(byte))
        count += protocol::peek(*body)->message_id == protocol::Telemetry::kId ? 1 : 0;
    board_.ports().lane(0).to_host.clear();
    return count;
  }

  std::uint16_t request_ = 0;
  mock::Board board_;
  Robot<mock::Board> robot_{board_};
};

TEST_F(TelemetryRate, IsKeptInTheMeanByAMainLoopThatComesLate) {
  ask_for_every(10);
  run(7000, 7);  // due every 10 ms, checked every 7 ms
  EXPECT_NEAR(frames(), 700, 2);
}

TEST_F(TelemetryRate, IsThatOfAMainLoopWhichIsSlower) {
  ask_for_every(10);
  run(1300, 13);
  EXPECT_NEAR(frames(), 100, 1) << "one in each turn, and none is made up for";
}

TEST_F(TelemetryRate, MakesUpForNothingAfterALongPause) {
  ask_for_every(10);
  run(100, 1);
  frames();
  run(1000, 1000);
  EXPECT_EQ(frames(), 1);
  run(100, 1);
  EXPECT_NEAR(frames(), 10, 1);
}

TEST_F(TelemetryRate, OfNoPeriodIsNone) {
  ask_for_every(10);
  run(100, 1);
  EXPECT_NEAR(frames(), 10, 1);
  ask_for_every(0);
  run(100, 1);
  EXPECT_EQ(frames(), 0);
}

}  // namespace
}  // namespace astro
