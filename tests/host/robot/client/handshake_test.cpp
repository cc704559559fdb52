#include <gmock/gmock.h>

#include "host/robot/client/client.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/links/fake_link.hpp"
#include "tests/support/links/scripted_transport.hpp"

namespace astro::robot {
namespace {

using support::Tells;
using test::FakeLink;
using test::Fate;
using test::ScriptedTransport;
using testing::HasSubstr;
using Bytes = std::vector<std::uint8_t>;

Remark refusal(Transport& transport) {
  Client client(transport);
  return support::told_by([&] { client.connect(); });
}

std::string why_not(Transport& transport) {
  const std::string fact = refusal(transport).sentence;
  return fact.empty() ? "connected" : fact;
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
  EXPECT_THAT(refusal(silent), Tells("port0 does not answer", Help::check_robot_and_baud));
  EXPECT_LT(silent.now(), std::chrono::seconds(2)) << "somebody waits in front of the screen";
}

TEST(Handshake, SaysThatADeviceThatSendsSomethingElseIsNoRobot) {
  ScriptedTransport gps([](auto) {
    const char* text = "$GPGGA,123519,4807.038,N\r\n";
    return Bytes(text, text + 26);
  });
  EXPECT_THAT(why_not(gps), HasSubstr("port0 is not an Astrolabe robot"));
}

TEST(Handshake, SaysThatALineIsLoopedBack) {
  ScriptedTransport echo([](auto bytes) { return Bytes(bytes.begin(), bytes.end()); });
  EXPECT_THAT(why_not(echo), HasSubstr("sends back what it is sent"));
}

TEST(Handshake, SaysThatARobotSendsButDoesNotHear) {
  ScriptedTransport deaf([](auto) { return frame_of(protocol::Telemetry{}, 0); });
  EXPECT_THAT(refusal(deaf), Tells(HasSubstr("does not answer"), Help::check_line));
}

std::string versions(int robots) {
  return "speaks protocol " + std::to_string(robots) + ", this program speaks " +
         std::to_string(protocol::kProtocolVersion);
}

TEST(Handshake, NamesBothVersionsAndWhatToUpdate) {
  FakeLink newer;
  newer.robot.identity.protocol_version = protocol::kProtocolVersion + 1;
  EXPECT_THAT(refusal(newer),
              Tells(HasSubstr(versions(protocol::kProtocolVersion + 1)), Help::update_program));
  FakeLink older;
  older.robot.identity.protocol_version = protocol::kProtocolVersion - 1;
  EXPECT_THAT(refusal(older),
              Tells(HasSubstr(versions(protocol::kProtocolVersion - 1)), Help::update_firmware));
}

TEST(Handshake, UnderstandsARobotThatRefusesTheVersion) {
  FakeLink link;
  link.robot.refuse_next = protocol::ErrorReply{protocol::ErrorCode::wrong_version, 9};
  EXPECT_THAT(refusal(link), Tells(HasSubstr(versions(9)), Help::update_program));
}

TEST(Handshake, SurvivesLostFramesAndARestartOfTheRobot) {
  FakeLink link;
  int left = 3;
  link.fate = [&](bool, std::uint8_t) { return left-- > 0 ? Fate::lost : Fate::arrives; };
  link.robot.event(protocol::Booted{protocol::ResetCause::power_on});
  EXPECT_EQ(why_not(link), "connected");
}

}  // namespace
}  // namespace astro::robot
