/// A node and peers with the settings of stock nodes, on two computers (tests/support/ros2/two_computers.hpp).
#include <gmock/gmock.h>
#include <linux/if_ether.h>
#include <netinet/in.h>

#include <optional>

#include "tests/support/ros2/domain.hpp"
#include "tests/support/ros2/peer_program.hpp"
#include "tests/support/ros2/robot_node.hpp"
#include "tests/support/ros2/two_computers.hpp"

namespace astro::live {
namespace {

using std::chrono::steady_clock;
using support::PeerKind;
using support::PeerProgram;
using support::RobotNode;
using support::TwoComputers;

constexpr auto kTimeout = std::chrono::seconds(30);  // only a failure waits so long

/// IPv4 packets of any kind that come to a computer.
class Arrivals {
 public:
  Arrivals() : socket_(socket(AF_PACKET, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, htons(ETH_P_IP))) {}
  ~Arrivals() { close(socket_); }
  Arrivals(const Arrivals&) = delete;
  Arrivals& operator=(const Arrivals&) = delete;

  int count() {
    for (char byte; recv(socket_, &byte, 1, 0) >= 0;) ++count_;
    return count_;
  }

 private:
  int socket_, count_ = 0;
};

class NodeOnANetwork : public testing::Test {
 protected:
  void SetUp() override {
    domain_ = support::test_domain();
    two_ = TwoComputers::make();
    if (!two_) GTEST_SKIP() << "network namespaces take root and the command ip";
  }

  /// Of each kind one here and one on the other computer.
  void start_peers(const std::string& option) {
    for (const PeerKind kind : {PeerKind::fast, PeerKind::cyclone}) {
      if (support::path_of(kind).empty()) continue;
      const auto start = [&] { peers_.push_back(std::make_unique<PeerProgram>(kind, domain_, option)); };
      start();
      two_->on_the_other(start);
    }
  }
  void say_to_all(const std::string& command) {
    for (const auto& peer : peers_) peer->say(command);
  }
  /// How many lines of this beginning each peer has printed.
  std::vector<std::size_t> lines(const std::string& beginning) {
    std::vector<std::size_t> counts;
    for (const auto& peer : peers_) counts.push_back(peer->lines(beginning).size());
    return counts;
  }
  bool all_have(const std::string& beginning, std::size_t count) {
    return std::ranges::all_of(lines(beginning), [&](std::size_t lines) { return lines >= count; });
  }
  template <class Condition>
  static bool eventually(RobotNode* robot, Condition condition) {
    const auto end = steady_clock::now() + kTimeout;
    while (!condition()) {
      if (steady_clock::now() > end) return false;
      robot != nullptr ? robot->step() : static_cast<void>(poll(nullptr, 0, 1));
    }
    return true;
  }

  int domain_ = 0;
  std::unique_ptr<TwoComputers> two_;
  std::vector<std::unique_ptr<PeerProgram>> peers_;
};

TEST_F(NodeOnANetwork, PeersHereAndThereGetAllTopicsAndAllAnswersWhoeverStartsFirst) {
  for (const bool node_first : {true, false}) {
    peers_.clear();
    std::optional<RobotNode> robot;
    if (node_first) robot.emplace(dds::Discovery{domain_, dds::Range::subnet});
    start_peers("subnet");
    for (const char* topic : RobotNode::kTopics) say_to_all(std::string("sub ") + topic + " odometry");
    ASSERT_TRUE(eventually(nullptr, [&] { return all_have("subscribed", RobotNode::kTopics.size()); }));
    if (!node_first) robot.emplace(dds::Discovery{domain_, dds::Range::subnet});
    for (const char* topic : RobotNode::kTopics)
      ASSERT_TRUE(eventually(&*robot, [&] { return all_have(std::string("got ") + topic, 1); })) << topic;
    for (const char* service : RobotNode::kServices) say_to_all(std::string("call ") + service);
    ASSERT_TRUE(eventually(&*robot, [&] { return all_have("reply", RobotNode::kServices.size()); }))
        << testing::PrintToString(lines("reply"));
    for (const auto& [service, calls] : robot->calls)
      EXPECT_EQ(calls, static_cast<int>(peers_.size())) << service << " is carried out once for each call";
  }
}

TEST_F(NodeOnANetwork, WithTheRangeOfThisComputerNothingLeavesIt) {
  const auto there = two_->on_the_other([] { return std::make_unique<Arrivals>(); });
  {
    RobotNode robot(dds::Discovery{domain_});
    PeerProgram& peer = *peers_.emplace_back(std::make_unique<PeerProgram>(PeerKind::fast, domain_));
    peer.say("sub /odom odometry");
    ASSERT_TRUE(eventually(&robot, [&] { return all_have("got /odom", 10); }));
    EXPECT_EQ(there->count(), 0);
  }
  peers_.clear();
  RobotNode robot(dds::Discovery{domain_, dds::Range::subnet});
  EXPECT_TRUE(eventually(&robot, [&] { return there->count() > 0; })) << "they would have been seen";
}

}  // namespace
}  // namespace astro::live
