#include "host/formats/cdr/names.hpp"

#include <gmock/gmock.h>

#include "host/base/error.hpp"

namespace astro::ros2 {
namespace {

const NodeName kRobot{"robot", "/hall/left"};

TEST(Names, AbsoluteOnesBecomeThoseOnTheWire) {
  EXPECT_EQ(wire_name_of_topic("/odom"), "rt/odom");
  EXPECT_EQ(wire_name_of_topic("/a/b_2"), "rt/a/b_2");
  EXPECT_EQ(wire_name_of_requests("/robot/arm"), "rq/robot/armRequest");
  EXPECT_EQ(wire_name_of_replies("/robot/arm"), "rr/robot/armReply");
}

TEST(Names, AreResolvedAgainstTheNamespaceAndTheNode) {
  EXPECT_EQ(resolved("/odom", kRobot), "/odom");
  EXPECT_EQ(resolved("odom", kRobot), "/hall/left/odom");
  EXPECT_EQ(resolved("~/odom", kRobot), "/hall/left/robot/odom");
  EXPECT_EQ(resolved("odom", {"robot"}), "/odom");
  EXPECT_EQ(resolved("~/odom", {"robot"}), "/robot/odom");
  EXPECT_EQ(full_name(kRobot), "/hall/left/robot");
  EXPECT_EQ(full_name({"robot"}), "/robot");
}

TEST(Names, ThatRos2WouldRefuseAreRefused) {
  for (const char* name : {"", "odom", "/", "//odom", "/odom/", "/a//b", "/2d", "/a/2d", "/a b", "/a-b",
                           "/\xC3\xA4", "~/odom", "/a.b"})
    EXPECT_THROW(wire_name_of_topic(name), Error) << name;
  for (const char* name : {"", "~", "a//b", "a/", "2d"}) EXPECT_THROW(resolved(name, kRobot), Error) << name;
  EXPECT_THROW(wire_name_of_topic('/' + std::string(kLongestTopicName, 'a')), Error);
  EXPECT_NO_THROW(wire_name_of_topic('/' + std::string(kLongestTopicName - 1, 'a')));
}

TEST(Names, FullOnesAreToldFromOthers) {
  for (const char* name : {"/tf", "/vrpn_mocap/robot_1/pose", "/_a/B9"})
    EXPECT_TRUE(is_full_name(name)) << name;
  for (const char* name : {"", "/", "tf", "/tf/", "//tf", "/a//b", "/1a", "/a b", "~/pose", "/\xC3\xA9"})
    EXPECT_FALSE(is_full_name(name)) << name;
}

TEST(Names, OfNodesAndNamespacesAreJudgedAlike) {
  EXPECT_NO_THROW(valid(kRobot));
  EXPECT_NO_THROW(valid({"_robot2", "/"}));
  for (const char* name : {"", "a/b", "/a", "2d", "a b"}) EXPECT_THROW(valid({name, "/"}), Error) << name;
  for (const char* name_space : {"", "a", "/a/", "//", "/2"})
    EXPECT_THROW(valid({"robot", name_space}), Error) << name_space;
}

TEST(Names, AMessageSaysWhichNameIsWrongAndWhatTheRuleIs) {
  try {
    valid({"my robot", "/"});
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "the name of the node is 'my robot': it has to be letters, digits and underscores, and must "
                 "not begin "
                 "with a digit");
  }
}

}  // namespace
}  // namespace astro::ros2
