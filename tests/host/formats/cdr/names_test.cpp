#include "host/formats/cdr/names.hpp"

#include <gmock/gmock.h>

#include "tests/support/base/remarks.hpp"

namespace astro::ros2 {
namespace {

using support::ThrowsTelling;

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
    EXPECT_THAT([&] { wire_name_of_topic(name); }, ThrowsTelling(NameProblem::malformed, "name", name));
  for (const std::string name : {"", "~", "a//b", "a/", "2d"})
    EXPECT_THAT([&] { resolved(name, kRobot); },
                ThrowsTelling(NameProblem::malformed, "name", "/hall/left/" + name));
  const std::string long_name = '/' + std::string(kLongestTopicName, 'a');
  EXPECT_THAT([&] { wire_name_of_topic(long_name); },
              ThrowsTelling(NameProblem::too_long, "name", long_name));
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
  for (const char* name : {"", "a/b", "/a", "2d", "a b", "my robot"})
    EXPECT_THAT(([&] {
                  valid({name, "/"});
                }),
                ThrowsTelling(NameProblem::malformed, "name of the node", name));
  for (const char* name_space : {"", "a", "/a/", "//", "/2"})
    EXPECT_THAT(([&] {
                  valid({"robot", name_space});
                }),
                ThrowsTelling(NameProblem::malformed, "namespace", name_space));
}

}  // namespace
}  // namespace astro::ros2
