#include <fcntl.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "common/protocol/frame.hpp"
#include "common/protocol/framer.hpp"
#include "common/protocol/session.hpp"
#include "tests/support/links/pty_peer.hpp"
#include "tests/support/programs/program.hpp"

// Ports without a robot, or of another user: one sentence that names the port and the reason.
namespace astro {
namespace {

using support::Outcome;
using test::PtyPeer;
using testing::HasSubstr;
using Bytes = PtyPeer::Bytes;

void refuses(const std::string& port, const std::string& reason) {
  const Outcome outcome = support::astrolabe({"info", "--port", port});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(port));
  EXPECT_THAT(outcome.err, HasSubstr(reason));
}

/// Answers each request with a message under its request id.
template <class Reply>
PtyPeer::Answer robot_that_answers(Reply reply) {
  return [reply, framer = std::make_shared<protocol::Framer>()](std::span<const std::uint8_t> bytes) {
    Bytes out;
    for (const std::uint8_t byte : bytes)
      if (const auto body = framer->push(byte)) {
        const protocol::Frame frame(reply, protocol::peek(*body)->request_id);
        out.insert(out.end(), frame.bytes().begin(), frame.bytes().end());
      }
    return out;
  };
}

TEST(Stranger, ThatIsSilent) {
  const PtyPeer peer([](auto) { return Bytes{}; });
  refuses(peer.path(), "does not answer");
}

TEST(Stranger, ThatSendsBackWhatItIsSent) {
  const PtyPeer peer([](auto bytes) { return Bytes(bytes.begin(), bytes.end()); });
  refuses(peer.path(), "sends back what it is sent");
}

TEST(Stranger, ThatTalksAboutSomethingElse) {
  const PtyPeer peer([](auto) {
    const std::string text = "login: ";
    return Bytes(text.begin(), text.end());
  });
  refuses(peer.path(), "is not an Astrolabe robot");
}

TEST(Stranger, ThatIsARobotOfANewerProtocol) {
  const PtyPeer peer(robot_that_answers(protocol::ErrorReply{protocol::ErrorCode::wrong_version, 9}));
  refuses(peer.path(), "speaks protocol 9");
}

TEST(Stranger, ThatIsARobotOfAnotherProtocolAndSaysSoInItsHello) {
  protocol::HelloReply hello;
  hello.protocol_version = 0;
  const PtyPeer peer(robot_that_answers(hello));
  refuses(peer.path(), "update the robot's firmware");
}

TEST(Stranger, ThatIsAFile) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path() / "file";
  std::ofstream(path) << "not a port";
  refuses(path, "is not a serial port");
}

TEST(Stranger, ThatIsAFolder) {
  const test::TemporaryFolder folder;
  refuses(folder.path().string(), "is a folder");
}

TEST(Stranger, ThatIsNotThere) { refuses("/no/such/port", "there is no port"); }

TEST(Stranger, ThatIsAnAddressOnAnotherMachine) { refuses("tcp:192.0.2.1:5555", "is not on this machine"); }

TEST(Stranger, ThatHasLeftItsPtyBehind) {
  test::Pty pty;
  const std::string path = pty.path();
  // Kept open, so that no simulator of a test that runs at the same time gets its number.
  const int other_side = open(path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  pty.hang_up();
  refuses(path, "");
  close(other_side);
}

}  // namespace
}  // namespace astro
