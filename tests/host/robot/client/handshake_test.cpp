#include <gmock/gmock.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "host/robot/client/client.hpp"
#include "host/robot/client/handshake.hpp"
#include "host/robot/port/transport.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/links/fake_link.hpp"

namespace astro::robot {

namespace {

/// Something at a port that answers each write with bytes of a test's choice, in virtual time.
class ScriptedTransport : public robot::Transport {
 public:
  using Bytes = std::vector<std::uint8_t>;
  using Answer = std::function<Bytes(std::span<const std::uint8_t>)>;

  explicit ScriptedTransport(Answer answer) : answer_(std::move(answer)) {}

  void write(std::span<const std::uint8_t> bytes) override {
    const Bytes more = answer_(bytes);
    waiting_.insert(waiting_.end(), more.begin(), more.end());
  }
  std::size_t read(std::span<std::uint8_t> into, microseconds timeout) override {
    if (waiting_.empty()) now_ += timeout;
    const std::size_t size = std::min(into.size(), waiting_.size());
    std::copy_n(waiting_.begin(), size, into.begin());
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(size));
    return size;
  }
  microseconds now() const override { return now_; }
  void reopen(microseconds) override { waiting_.clear(); }
  const std::string& name() const override { return name_; }

 private:
  Answer answer_;
  Bytes waiting_;
  std::string name_ = "port0";
  microseconds now_{0};
};

using support::Tells;
using test::FakeLink;
using test::Fate;
using Bytes = std::vector<std::uint8_t>;

Remark refusal(Transport& transport) {
  Client client(transport);
  return support::told_by([&] { client.connect(); });
}

template <protocol::Message M>
Bytes frame_of(const M& message, std::uint16_t request_id) {
  const protocol::Frame frame(message, request_id);
  return {frame.bytes().begin(), frame.bytes().end()};
}

TEST(Handshake, TellsWhoTheRobotIs) {
  FakeLink link;
  Client client(link);
  EXPECT_EQ(client.connect(), link.robot.identity);
  EXPECT_EQ(client.robot().robot_name.view(), "astro");
}

TEST(Handshake, ForgetsBytesOfAnEarlierProgramBeforeItAsks) {
  FakeLink link;
  {
    Client earlier(link);
    earlier.connect();
    earlier.request(protocol::SetTelemetry{10, protocol::Telemetry::kPose});
    link.robot.event(protocol::FaultRaised{Fault::stall, 1});
    link.robot.receive({});
  }
  Client client(link);
  int faults = 0;
  const auto subscription = client.on<protocol::FaultRaised>([&](const auto&) { ++faults; });
  client.connect();
  EXPECT_EQ(faults, 0);
  EXPECT_EQ(client.frames().bad(), 0U);
}

TEST(Handshake, SaysThatNothingAnswers) {
  ScriptedTransport silent([](auto) { return Bytes{}; });
  EXPECT_THAT(refusal(silent), Tells(HandshakeProblem::nothing_comes, "port0"));
  EXPECT_LT(silent.now(), std::chrono::seconds(2)) << "somebody waits in front of the screen";
}

TEST(Handshake, SaysThatADeviceThatSendsSomethingElseIsNoRobot) {
  ScriptedTransport gps([](auto) {
    const char* text = "$GPGGA,123519,4807.038,N\r\n";
    return Bytes(text, text + 26);
  });
  EXPECT_THAT(refusal(gps), Tells(HandshakeProblem::no_frames, "port0"));
}

TEST(Handshake, SaysThatALineIsLoopedBack) {
  ScriptedTransport echo([](auto bytes) { return Bytes(bytes.begin(), bytes.end()); });
  EXPECT_THAT(refusal(echo), Tells(HandshakeProblem::looped_back, "port0"));
}

TEST(Handshake, SaysThatARobotSendsButDoesNotHear) {
  ScriptedTransport deaf([](auto) { return frame_of(protocol::Telemetry{}, 0); });
  EXPECT_THAT(refusal(deaf), Tells(HandshakeProblem::robot_does_not_hear, "port0"));
}

/// Of a refusal: it names this version of the robot's and the program's own.
auto names_versions(HandshakeProblem problem, int robots) {
  return Tells(problem, "fake0", std::to_string(robots), std::to_string(protocol::kProtocolVersion));
}

TEST(Handshake, NamesBothVersionsAndWhatToUpdate) {
  FakeLink newer;
  newer.robot.identity.protocol_version = protocol::kProtocolVersion + 1;
  EXPECT_THAT(refusal(newer),
              names_versions(HandshakeProblem::program_outdated, protocol::kProtocolVersion + 1));
  FakeLink older;
  older.robot.identity.protocol_version = protocol::kProtocolVersion - 1;
  EXPECT_THAT(refusal(older),
              names_versions(HandshakeProblem::firmware_outdated, protocol::kProtocolVersion - 1));
}

TEST(Handshake, UnderstandsARobotThatRefusesTheVersion) {
  FakeLink link;
  link.robot.refuse_next = protocol::ErrorReply{protocol::ErrorCode::wrong_version, 9};
  EXPECT_THAT(refusal(link), names_versions(HandshakeProblem::program_outdated, 9));
}

TEST(Handshake, SurvivesLostFramesAndARestartOfTheRobot) {
  FakeLink link;
  int left = 3;
  link.fate = [&](bool, std::uint8_t) { return left-- > 0 ? Fate::lost : Fate::arrives; };
  link.robot.event(protocol::Booted{protocol::ResetCause::power_on});
  EXPECT_NO_THROW(Client(link).connect());
}

}  // namespace

}  // namespace astro::robot
