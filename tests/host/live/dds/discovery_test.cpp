#include "host/live/dds/discovery.hpp"

#include <gmock/gmock.h>

#include <map>

#include "host/base/error.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::dds {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Variables = std::map<std::string, std::string>;

Discovery from(const Variables& variables, const DiscoveryWishes& wishes = {}) {
  return discovery_from(wishes, [&](const char* name) {
    const auto found = variables.find(name);
    return found == variables.end() ? std::string() : found->second;
  });
}

TEST(Discovery, AWishMakesAWrongVariableHarmless) {
  const auto variable = [](const char* name) {
    return std::string(name) == "ROS_DOMAIN_ID" ? std::string("abc") : std::string();
  };
  EXPECT_EQ(discovery_from({.domain = 5, .range = {}}, variable).domain, 5);
  EXPECT_THROW(discovery_from({}, variable), Error);
}

TEST(Discovery, IsDomainZeroOfThisComputerUnlessSomebodyAsks) {
  const Discovery discovery = from({});
  EXPECT_EQ(discovery.domain, 0);
  EXPECT_EQ(discovery.range, Range::localhost);
  EXPECT_THAT(discovery.peers, IsEmpty());
}

TEST(Discovery, FollowsTheVariablesOfRos2) {
  EXPECT_EQ(from({{"ROS_DOMAIN_ID", "42"}}).domain, 42);
  EXPECT_EQ(from({{"ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET"}}).range, Range::subnet);
  EXPECT_EQ(from({{"ROS_AUTOMATIC_DISCOVERY_RANGE", "subnet"}}).range, Range::subnet);
  EXPECT_EQ(from({{"ROS_AUTOMATIC_DISCOVERY_RANGE", "SYSTEM_DEFAULT"}}).range, Range::subnet);
  EXPECT_EQ(from({{"ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST"}}).range, Range::localhost);
  EXPECT_EQ(from({{"ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF"}}).range, Range::off);
  EXPECT_THAT(from({{"ROS_STATIC_PEERS", "192.168.0.1;;robot.local;"}}).peers,
              ElementsAre("192.168.0.1", "robot.local"));
  EXPECT_THAT(from({{"ROS_STATIC_PEERS", "a"}, {"ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF"}}).peers, IsEmpty());
}

TEST(Discovery, TheVariableOfHumbleWins) {
  EXPECT_EQ(from({{"ROS_LOCALHOST_ONLY", "1"}, {"ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET"}}).range,
            Range::localhost);
  EXPECT_EQ(from({{"ROS_LOCALHOST_ONLY", "0"}}).range, Range::subnet) << "who says 0 asks for the network";
  EXPECT_EQ(from({{"ROS_LOCALHOST_ONLY", "0"}, {"ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF"}}).range, Range::off);
}

TEST(Discovery, WhoAsksForThisComputerAloneInTheWordsOfHumbleHasNoPeers) {
  const Variables variables{{"ROS_LOCALHOST_ONLY", "1"}, {"ROS_STATIC_PEERS", "192.168.0.1"}};
  EXPECT_THAT(from(variables).peers, IsEmpty()) << "with a peer, sockets would be open to the network";
  EXPECT_THAT(from(variables, {.domain = {}, .range = Range::subnet}).peers, ElementsAre("192.168.0.1"))
      << "the wish has taken the variable's place";
  EXPECT_THAT(from({{"ROS_LOCALHOST_ONLY", "0"}, {"ROS_STATIC_PEERS", "a"}}).peers, ElementsAre("a"));
}

TEST(Discovery, AWishWinsOverAll) {
  const Discovery discovery =
      from({{"ROS_LOCALHOST_ONLY", "1"}, {"ROS_DOMAIN_ID", "7"}, {"ROS_STATIC_PEERS", "a"}}, {3, Range::off});
  EXPECT_EQ(discovery.domain, 3);
  EXPECT_EQ(discovery.range, Range::off);
  EXPECT_THAT(discovery.peers, IsEmpty());
}

TEST(Discovery, AnUnknownValueIsRefusedByTheNameOfItsVariable) {
  for (const auto& [name, value] : Variables{{"ROS_DOMAIN_ID", "233"},
                                             {"ROS_AUTOMATIC_DISCOVERY_RANGE", "EVERYWHERE"},
                                             {"ROS_LOCALHOST_ONLY", "yes"}}) {
    const Variables variables{{name, value}};
    EXPECT_THAT([&] { from(variables); },
                support::ThrowsTelling(DiscoveryProblem::unknown_value, name, value));
  }
  for (const char* text : {"-1", "1x", " 1", "1.5"})
    EXPECT_THROW(from({{"ROS_DOMAIN_ID", text}}), Error) << text;
}

}  // namespace
}  // namespace astro::dds
