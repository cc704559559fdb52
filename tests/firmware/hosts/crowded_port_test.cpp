#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "common/protocol/frame.hpp"
#include "firmware/app/robot.hpp"
#include "hal/mock/board.hpp"

// More bytes than the line can carry: answers go first, then events, and telemetry gets the rest.
namespace astro {
namespace {

using protocol::Telemetry;

/// The robot at two serial ports of 1,000,000 baud, 100 bytes a millisecond each.
class CrowdedPort : public testing::Test {
 protected:
  static constexpr std::size_t kBytesPerMs = 100;
  struct Received {
    std::vector<std::uint16_t> answered;  // request ids
    std::vector<std::uint16_t> tags;      // of SegmentStarted
    int telemetry = 0, faults = 0, missed = 0;
  };

  CrowdedPort() {
    for (auto& lane : board_.ports().lanes) lane.capacity = 1024;
    run_ms(40);  // through boot
  }

  template <protocol::Message M>
  void send(const M& message, std::uint16_t request, int port = 0) {
    const protocol::Frame frame(message, request);
    auto& waiting = board_.ports().lane(port).to_robot;
    waiting.insert(waiting.end(), frame.bytes().begin(), frame.bytes().end());
  }
  void run_ms(int ms) {
    for (int i = 0; i < ms; ++i) {
      board_.clock().time_us += 1000;
      robot_.tick();
      robot_.poll();
      for (int port = 0; port < 2; ++port)
        if (read_[static_cast<std::size_t>(port)]) drain(port, kBytesPerMs);
    }
  }
  void drain(int port, std::size_t bytes) {
    auto& sent = board_.ports().lane(port).to_host;
    const std::size_t count = std::min(bytes, sent.size());
    for (std::size_t i = 0; i < count; ++i)
      if (const auto body = framers_[static_cast<std::size_t>(port)].push(sent[i])) take(port, *body);
    sent.erase(sent.begin(), sent.begin() + static_cast<std::ptrdiff_t>(count));
  }
  void take(int port, std::span<const std::uint8_t> body) {
    Received& got = received_[static_cast<std::size_t>(port)];
    const protocol::Header header = *protocol::peek(body);
    if (header.request_id != 0) return got.answered.push_back(header.request_id);
    got.telemetry += header.message_id == Telemetry::kId ? 1 : 0;
    got.faults += header.message_id == protocol::FaultRaised::kId ? 1 : 0;
    if (header.message_id == protocol::SegmentStarted::kId)
      got.tags.push_back(protocol::decode<protocol::SegmentStarted>(body)->tag);
    if (header.message_id == protocol::EventsMissed::kId)
      got.missed += protocol::decode<protocol::EventsMissed>(body)->count;
  }
  void ask_for_everything(int port) { send(protocol::SetTelemetry{1, Telemetry::kAll}, 1, port); }
  /// Causes an event: raises a fault and clears it.
  void raise_a_fault(int port = 0) {
    send(protocol::EmergencyStop{}, next_++, port);
    run_ms(1);
    send(protocol::ClearFaults{}, next_++, port);
    run_ms(1);
  }

  mock::Board board_;
  Robot<mock::Board> robot_{board_};
  std::array<protocol::Framer, 2> framers_;
  std::array<Received, 2> received_;
  std::array<bool, 2> read_{true, true};
  std::uint16_t next_ = 100;
};

TEST_F(CrowdedPort, AnswersEveryRequestWhileTelemetryFillsTheLine) {
  ask_for_everything(0);
  run_ms(100);
  received_[0] = {};
  std::uint16_t asked = 0;
  for (int ms = 0; ms < 2000; ms += 5) {
    send(protocol::Ping{}, next_++);
    asked += 1;
    // The largest answer, as often as a host that reads the parameter table requests it.
    if (ms % 20 == 0) {
      send(protocol::GetParameterInfo{2}, next_++);
      asked += 1;
    }
    run_ms(5);
  }
  run_ms(50);
  EXPECT_EQ(received_[0].answered.size(), asked);
  fmt::print("{} of {} requests answered beside {} samples of telemetry in 2 s\n",
             received_[0].answered.size(), asked, received_[0].telemetry);
  // 162 bytes each; the line takes 100 a millisecond, of which the answers take 14.
  EXPECT_GT(received_[0].telemetry, 910) << "what the line has to spare is used";
}

TEST_F(CrowdedPort, AnswersWithoutLongDelay) {
  ask_for_everything(0);
  run_ms(200);
  for (int i = 0; i < 20; ++i) {
    received_[0].answered.clear();
    send(protocol::Ping{}, next_++);
    run_ms(8);  // for the telemetry that is already in the queue, at most half of 1,024 bytes
    EXPECT_EQ(received_[0].answered.size(), 1U);
  }
}

TEST_F(CrowdedPort, KeepsEveryEventWhileTelemetryFillsTheLine) {
  ask_for_everything(0);
  run_ms(100);
  received_[0] = {};
  for (int i = 0; i < 200; ++i) raise_a_fault();
  run_ms(100);
  EXPECT_EQ(received_[0].faults, 200);
  EXPECT_EQ(received_[0].missed, 0);
}

TEST_F(CrowdedPort, KeepsEventsForAHostThatReadsLate) {
  ask_for_everything(0);
  run_ms(100);
  received_[0] = {};
  read_[0] = false;  // nobody reads, and the queue of 1,024 bytes is soon full
  for (int i = 0; i < 40; ++i) raise_a_fault(1);
  read_[0] = true;
  run_ms(100);
  EXPECT_EQ(received_[0].faults, 40);
  EXPECT_EQ(received_[0].missed, 0);
}

TEST_F(CrowdedPort, SaysHowManyEventsAPortHasMissedAndKeepsNoneFromTheOther) {
  run_ms(100);
  received_ = {};
  read_[0] = false;
  constexpr int kEvents = 300;
  for (int i = 0; i < kEvents; ++i) raise_a_fault(1);
  run_ms(50);
  EXPECT_EQ(received_[1].faults, kEvents);
  EXPECT_EQ(received_[1].missed, 0);
  read_[0] = true;
  run_ms(100);
  EXPECT_EQ(received_[0].faults + received_[0].missed, kEvents) << "none goes without a word";
  EXPECT_GT(received_[0].missed, 0);
  EXPECT_GE(received_[0].faults, 64);
  received_[0] = {};
  raise_a_fault(1);
  run_ms(10);
  EXPECT_EQ(received_[0].missed, 0) << "told once";
}

TEST_F(CrowdedPort, ANewHostIsNotToldWhatTheOneBeforeItMissed) {
  run_ms(100);
  read_[0] = false;
  for (int i = 0; i < 300; ++i) raise_a_fault(1);
  board_.ports().lane(0).to_host.clear();
  received_ = {};
  send(protocol::Hello{}, 1);
  read_[0] = true;
  run_ms(100);
  EXPECT_EQ(received_[0].answered.size(), 1U);
  EXPECT_EQ(received_[0].faults + received_[0].missed, 0);
}

}  // namespace
}  // namespace astro
