/// A node and peers in processes of their own, on loopback: one on Fast DDS that calls as rmw_fastrtps does, one on CycloneDDS
/// that calls as rmw_cyclonedds does.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <chrono>
#include <cmath>

#include "host/formats/cdr/codec.hpp"
#include "host/formats/messages/geometry.hpp"
#include "host/formats/messages/parameters.hpp"
#include "host/formats/messages/std.hpp"
#include "host/live/dds/fast_dds.hpp"
#include "host/live/ros2/node.hpp"
#include "tests/host/live/ros2/parameters_of.hpp"
#include "tests/support/ros2/domain.hpp"
#include "tests/support/ros2/peer_program.hpp"

namespace astro::live {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using support::number_in;
using support::PeerKind;
using support::PeerProgram;
using support::word_in;
using testing::HasSubstr;
using testing::SizeIs;
using testing::StartsWith;

constexpr std::array kKinds{PeerKind::fast, PeerKind::cyclone};
constexpr auto kLong = std::chrono::seconds(30);  // only a failure waits so long

class NodeAmongPeers : public testing::Test {
 protected:
  std::unique_ptr<Middleware> open(GidSize gid_size = GidSize::iron_and_later) {
    return open_node({{"robot", "/hall"}, gid_size}, {support::test_domain()});
  }
  /// Nothing, with a message, if this build has no such peer.
  PeerProgram* start(PeerKind kind, const std::string& options = "") {
    if (support::path_of(kind).empty()) {
      std::cout << "without cyclonedds-dev there is no peer on CycloneDDS\n";
      return nullptr;
    }
    return peers_.emplace_back(std::make_unique<PeerProgram>(kind, support::test_domain(), options)).get();
  }
  template <class Condition>
  bool eventually(Middleware& node, Condition condition) {
    const auto end = steady_clock::now() + kLong;
    while (!condition()) {
      if (steady_clock::now() > end) return false;
      node.poll();
      node.wait(milliseconds(1));
    }
    return true;
  }
  /// Tells the peer to do something, and waits until it has printed a line that begins so.
  std::string ask(Middleware& node, PeerProgram& peer, const std::string& command,
                  const std::string& beginning) {
    const std::size_t before = peer.lines(beginning).size();
    peer.say(command);
    if (!eventually(node, [&] { return peer.lines(beginning).size() > before; }))
      return "no line '" + beginning + "' but:\n" + testing::PrintToString(peer.lines());
    return peer.lines(beginning).back();
  }

  std::vector<std::unique_ptr<PeerProgram>> peers_;
};

ros2::msg::Odometry odometry(int number) {
  ros2::msg::Odometry message;
  message.header = {ros2::msg::to_time(1'700'000'000'000'000'001 + number), "odom"};
  message.child_frame_id = "base_link";
  message.pose.pose.position = {0.1 * number, -2, 0};
  message.pose.pose.orientation = {0, 0, std::sin(0.5), std::cos(0.5)};
  message.pose.covariance[35] = 0.25;
  message.twist.twist = {{0.3, 0, 0}, {0, 0, 0.1}};
  return message;
}

TEST_F(NodeAmongPeers, BothReceiveALatchedTopicJoiningLateAndAVolatileOneWithRightValues) {
  const auto node = open();
  const auto description =
      node->advertise({"/robot_description", message_type<ros2::msg::String>(), true, true, 1});
  const auto odom = node->advertise({"/odom", message_type<ros2::msg::Odometry>()});
  description->publish(ros2::encode(ros2::msg::String{"<robot>\n</robot>"}), 0);
  node->poll();
  for (const PeerKind kind : kKinds) {
    PeerProgram* peer = start(kind);
    if (peer == nullptr) continue;
    peer->say("sub /robot_description text latched");
    peer->say("sub /odom odometry");
    int number = 0;
    ASSERT_TRUE(eventually(*node, [&] {
      odom->publish(ros2::encode(odometry(++number)), 0);
      return peer->lines("got /odom").size() >= 3;
    }));
    ASSERT_TRUE(eventually(*node, [&] { return !peer->lines("got /robot_description").empty(); }));
    EXPECT_THAT(peer->lines("got /robot_description"),
                testing::ElementsAre("got /robot_description text <robot>\\n</robot>"));
    const std::vector<std::string> lines = peer->lines("got /odom");
    int before = 0;  // a peer that gets no turn for a while misses some
    for (const std::string& line : lines) {
      const auto said = static_cast<int>(std::lround(10 * number_in(line, "x")));
      EXPECT_GT(said, before);
      EXPECT_EQ(number_in(line, "x"), 0.1 * said) << line;
      EXPECT_EQ(word_in(line, "stamp"), fmt::format("1700000000.{:09}", said + 1));
      before = said;
    }
    EXPECT_THAT(lines[0], HasSubstr("frame=odom child=base_link"));
    EXPECT_EQ(number_in(lines[0], "y"), -2);
    EXPECT_NEAR(number_in(lines[0], "heading"), 1, 1e-12);
    EXPECT_EQ(number_in(lines[0], "v"), 0.3);
    EXPECT_EQ(number_in(lines[0], "w"), 0.1);
    EXPECT_EQ(number_in(lines[0], "var_heading"), 0.25);
  }
}

TEST_F(NodeAmongPeers, BothPublishCmdVelUnderBothTypes) {
  const auto node = open();
  std::vector<ros2::msg::Twist> plain;
  std::vector<ros2::msg::TwistStamped> stamped;
  node->subscribe({"/cmd_vel", message_type<ros2::msg::TwistStamped>()}, [&](ByteView bytes) {
    if (const auto message = ros2::decode<ros2::msg::TwistStamped>(bytes)) stamped.push_back(*message);
  });
  node->subscribe({"/cmd_vel", message_type<ros2::msg::Twist>()}, [&](ByteView bytes) {
    if (const auto message = ros2::decode<ros2::msg::Twist>(bytes)) plain.push_back(*message);
  });
  for (const PeerKind kind : kKinds) {
    PeerProgram* peer = start(kind);
    if (peer == nullptr) continue;
    plain.clear();
    stamped.clear();
    EXPECT_EQ(ask(*node, *peer, "twist /cmd_vel 0.25 -0.5", "sent"), "sent /cmd_vel");
    EXPECT_EQ(ask(*node, *peer, "twist_stamped /cmd_vel 0.125 1.5 3", "sent"), "sent /cmd_vel");
    ASSERT_TRUE(eventually(*node, [&] { return !plain.empty() && !stamped.empty(); }));
    EXPECT_EQ(plain, (std::vector<ros2::msg::Twist>{{{0.25, 0, 0}, {0, 0, -0.5}}}));
    ASSERT_THAT(stamped, SizeIs(1));
    EXPECT_EQ(stamped[0].twist, (ros2::msg::Twist{{0.125, 0, 0}, {0, 0, 1.5}}));
    const double age_s =
        std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count() -
        1e-9 * static_cast<double>(ros2::msg::nanoseconds(stamped[0].header.stamp));
    EXPECT_GE(age_s, 3);
    EXPECT_LT(age_s, 3 + 30);  // as old as the peer made it, and as long as a busy machine took
  }
}

void serve_calls(Middleware& node, int& calls) {
  using ros2::msg::SetBool, ros2::msg::Trigger;
  node.serve(
      {"/hall/count", Trigger::kType, message_type<Trigger::Request>(), message_type<Trigger::Response>()},
      [&calls](ByteView bytes) -> std::optional<Bytes> {
        if (!ros2::decode<Trigger::Request>(bytes)) return std::nullopt;
        return ros2::encode(Trigger::Response{true, "call " + std::to_string(++calls)});
      });
  node.serve(
      {"/hall/enable", SetBool::kType, message_type<SetBool::Request>(), message_type<SetBool::Response>()},
      [](ByteView bytes) -> std::optional<Bytes> {
        const auto request = ros2::decode<SetBool::Request>(bytes);
        if (!request) return std::nullopt;
        return ros2::encode(SetBool::Response{request->data, request->data ? "on" : "off"});
      });
}

TEST_F(NodeAmongPeers, BothCallServicesInTheMannerOfTheirRmwInterleavedAHundredTimes) {
  constexpr std::size_t kCalls = 100;
  const auto node = open();
  int calls = 0;
  serve_calls(*node, calls);
  std::vector<PeerProgram*> peers;
  for (const PeerKind kind : kKinds)
    if (PeerProgram* peer = start(kind)) peers.push_back(peer);
  const auto answered = [&](std::size_t rounds) {
    return std::all_of(peers.begin(), peers.end(), [&](PeerProgram* peer) {
      return peer->lines("reply").size() + peer->lines("error").size() >= 2 * rounds;
    });
  };
  for (std::size_t i = 0; i < kCalls; ++i) {  // each waits for the other, so that they stay side by side
    for (PeerProgram* peer : peers) {
      peer->say("call /hall/count");
      peer->say(i % 2 == 0 ? "call /hall/enable true" : "call /hall/enable false");
    }
    ASSERT_TRUE(eventually(*node, [&] { return answered(i + 1); }));
  }
  for (PeerProgram* peer : peers) {
    EXPECT_THAT(peer->lines("error"), testing::IsEmpty()) << (peer == peers[0] ? "Fast DDS" : "CycloneDDS");
    EXPECT_THAT(peer->lines("reply /hall/count yes call "), SizeIs(kCalls));
    const auto switched = peer->lines("reply /hall/enable");
    ASSERT_THAT(switched, SizeIs(kCalls));
    for (std::size_t i = 0; i < kCalls; ++i)
      EXPECT_EQ(switched[i], i % 2 == 0 ? "reply /hall/enable yes on" : "reply /hall/enable no off");
  }
  EXPECT_EQ(calls, static_cast<int>(kCalls * peers.size())) << "each call is carried out once";
}

TEST_F(NodeAmongPeers, TheFirstCallOfAFreshClientIsAnsweredAndCarriedOutOnce) {
  constexpr int kClients = 10;
  const auto node = open();
  int calls = 0;
  serve_calls(*node, calls);
  for (const PeerKind kind : kKinds) {
    calls = 0;
    for (int i = 1; i <= kClients; ++i) {
      peers_.clear();
      PeerProgram* peer = start(kind);
      if (peer == nullptr) break;
      ASSERT_EQ(ask(*node, *peer, "call /hall/count", "reply"),
                fmt::format("reply /hall/count yes call {}", i));
      EXPECT_EQ(calls, i);
    }
  }
}

// Its lease is 10 s.
TEST_F(NodeAmongPeers, ACyclonePeerThatEndsIsGoneAtOnce) {
  const auto participant = dds::open_fast_dds({support::test_domain()}, "test", "");
  const auto writer =
      participant->create_writer({"rt/odom", ros2::dds_type_name(ros2::msg::Odometry::kType)});
  PeerProgram* peer = start(PeerKind::cyclone);
  if (peer == nullptr) GTEST_SKIP() << "CycloneDDS is not installed";
  const auto within = [&](double seconds, std::size_t readers) {
    const auto end = steady_clock::now() + std::chrono::duration<double>(seconds);
    while (participant->remote_endpoints().size() != readers && steady_clock::now() < end)
      participant->wait(milliseconds(5));
    return participant->remote_endpoints().size() == readers;
  };
  peer->say("sub /odom odometry");
  ASSERT_TRUE(within(30, 1));
  peers_.clear();
  EXPECT_TRUE(within(5, 0));
}

TEST_F(NodeAmongPeers, BothGetSetListAndDescribeParametersAndHearOfChanges) {
  const auto node = open();
  NumbersTable table({{"b", 0.25}, {"limits.speed", 1}});
  node->serve_parameters(table);
  for (const PeerKind kind : kKinds) {
    PeerProgram* peer = start(kind);
    if (peer == nullptr) continue;
    ask(*node, *peer, "sub /parameter_events event", "subscribed");
    table.set(std::vector<ros2::msg::Parameter>{{"b", real(0.25)}});
    EXPECT_EQ(ask(*node, *peer, "get /hall/robot b", "value"), "value b yes 0.25");
    EXPECT_EQ(ask(*node, *peer, "get /hall/robot c", "value"), "value c no ");
    EXPECT_EQ(ask(*node, *peer, "set /hall/robot b 0.5", "set"), "set b yes ");
    EXPECT_EQ(table.value("b"), real(0.5));
    EXPECT_EQ(ask(*node, *peer, "set /hall/robot c 1.5", "set"), "set c no the parameter 'c' is refused");
    EXPECT_EQ(ask(*node, *peer, "list /hall/robot", "names"), "names /hall/robot yes b limits.speed");
    EXPECT_EQ(ask(*node, *peer, "list /hall/robot 1", "names"), "names /hall/robot yes b");
    EXPECT_EQ(ask(*node, *peer, "list /hall/robot 0 limits", "names"), "names /hall/robot yes limits.speed");
    EXPECT_EQ(ask(*node, *peer, "describe /hall/robot b", "described"),
              "described b yes type=3 read_only=0 from=0 to=1000000 the number b");
    ASSERT_TRUE(eventually(*node, [&] { return !peer->lines("got /parameter_events").empty(); }));
    EXPECT_THAT(peer->lines("got /parameter_events").back(), testing::EndsWith("node=/hall/robot b=0.5"));
  }
}

TEST_F(NodeAmongPeers, BothReadWhatTheNodeHasWithTheIdentifiersOfTheirDistribution) {
  for (const GidSize gid_size : {GidSize::iron_and_later, GidSize::humble}) {
    const bool humble = gid_size == GidSize::humble;
    const auto node = open(gid_size);
    const auto odom = node->advertise({"/odom", message_type<ros2::msg::Odometry>()});
    node->subscribe({"/cmd_vel", message_type<ros2::msg::TwistStamped>()}, [](ByteView) {});
    node->subscribe({"/cmd_vel", message_type<ros2::msg::Twist>()}, [](ByteView) {});
    peers_.clear();
    for (const PeerKind kind : kKinds) {
      PeerProgram* peer = start(kind, humble ? "humble" : "");
      if (peer == nullptr) continue;
      peer->say("sub /ros_discovery_info graph latched");
      peer->say("sub /odom odometry");
      ASSERT_TRUE(eventually(*node, [&] { return !peer->lines("got /ros_discovery_info").empty(); }));
      ASSERT_TRUE(eventually(*node, [&] {
        ask(*node, *peer, "writers /odom", "writers");
        return !peer->lines("writer /odom").empty();
      }));
      const std::string line = peer->lines("got /ros_discovery_info").back();
      const std::string padding = humble ? std::string(16, '0') : "";
      EXPECT_THAT(line, HasSubstr("namespace=/hall name=robot"));
      const std::string guid = peer->lines("writer /odom").back().substr(13, 32);
      EXPECT_EQ(word_in(line, "writers"), guid + padding) << "the writer as this peer has found it";
      EXPECT_EQ(word_in(line, "participant").substr(0, 24), guid.substr(0, 24));
      EXPECT_THAT(word_in(line, "participant"), SizeIs(humble ? 48 : 32));
      EXPECT_THAT(word_in(line, "readers"), SizeIs(humble ? 2 * 48 + 1 : 2 * 32 + 1)) << "both of /cmd_vel";
    }
  }
}

// The hashes are those that ROS 2 has (facts: confirmed by captures of real nodes).
TEST_F(NodeAmongPeers, BothSeeTheHashesOfTypes) {
  const auto node = open();
  const auto odom = node->advertise({"/odom", message_type<ros2::msg::Odometry>()});
  const auto tf = node->advertise({"/tf", message_type<ros2::msg::TFMessage>()});
  for (const PeerKind kind : kKinds) {
    PeerProgram* peer = start(kind);
    if (peer == nullptr) continue;
    peer->say("sub /odom odometry");
    peer->say("sub /tf transforms");
    const auto shown = [&](const std::string& topic) {
      EXPECT_TRUE(eventually(*node, [&] {
        ask(*node, *peer, "writers " + topic, "writers");
        return !peer->lines("writer " + topic).empty();
      }));
      return peer->lines("writer " + topic).back();
    };
    EXPECT_THAT(
        shown("/odom"),
        HasSubstr(" typehash=RIHS01_3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0;"));
    EXPECT_THAT(
        shown("/tf"),
        HasSubstr(" typehash=RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087;"));
  }
}

TEST_F(NodeAmongPeers, ShowsThatItBelongsToAnEnclave) {
  const auto node = open();
  const auto odom = node->advertise({"/odom", message_type<ros2::msg::Odometry>()});
  PeerProgram* peer = start(PeerKind::cyclone);
  if (peer == nullptr) GTEST_SKIP() << "CycloneDDS is not installed";
  peer->say("sub /odom odometry");
  ASSERT_TRUE(eventually(*node, [&] {
    odom->publish(ros2::encode(odometry(1)), 0);
    return !peer->lines("got /odom").empty();
  }));
  ask(*node, *peer, "participants", "participants");
  EXPECT_THAT(peer->lines("participant "), testing::Contains("participant enclave=/;"));
}

TEST_F(NodeAmongPeers, ASubscriberThatHangsDoesNotHoldThePublisherUp) {
  const auto node = open();
  const auto odom = node->advertise({"/odom", message_type<ros2::msg::Odometry>()});
  for (const PeerKind kind : kKinds) {
    PeerProgram* peer = start(kind);
    if (peer == nullptr) continue;
    peer->say("sub /odom odometry");
    ASSERT_TRUE(eventually(*node, [&] {
      odom->publish(ros2::encode(odometry(1)), 0);
      return !peer->lines("got /odom").empty();
    }));
    kill(peer->pid(), SIGSTOP);
    const auto begin = steady_clock::now();
    for (int i = 0; i < 2000; ++i) odom->publish(ros2::encode(odometry(2)), 0);
    const std::chrono::duration<double> time = steady_clock::now() - begin;
    kill(peer->pid(), SIGCONT);
    // 2000 writes cost some 0.2 s. If each waited for the peer's acknowledgement, up to DDS's limit of 0.1 s, it were 200 s.
    EXPECT_LT(time.count(), 20);
    ASSERT_TRUE(eventually(*node, [&] {
      odom->publish(ros2::encode(odometry(77)), 0);
      return peer->lines("got /odom").back().find(" x=7.7") != std::string::npos;
    })) << "it goes on where it can";
  }
}

// How soon, in fifty starts: tests/bench, ros2_discovery.
TEST_F(NodeAmongPeers, FindsAPeerAndIsFoundAtEachStart) {
  for (const PeerKind kind : kKinds) {
    PeerProgram* peer = start(kind);
    if (peer == nullptr) continue;
    peer->say("sub /odom odometry");
    for (int start = 1; start <= 3; ++start) {
      const auto node = open();
      const auto odom = node->advertise({"/odom", message_type<ros2::msg::Odometry>()});
      const std::string mine = fmt::format("x={} ", 0.1 * (1000 * start));
      ASSERT_TRUE(eventually(*node, [&] {
        odom->publish(ros2::encode(odometry(1000 * start)), 0);
        const auto lines = peer->lines("got /odom");
        return !lines.empty() && lines.back().find(mine) != std::string::npos;
      }));
    }
  }
}

}  // namespace
}  // namespace astro::live
