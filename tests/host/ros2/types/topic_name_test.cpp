#include "host/ros2/types/topic_name.hpp"

#include <gtest/gtest.h>

namespace astro::ros2 {
namespace {

TEST(TopicName, IsAFullNameOfTokensThatAPathSeparates) {
  for (const char* name : {"/tf", "/vrpn_mocap/robot_1/pose", "/_a/B9"})
    EXPECT_TRUE(is_topic_name(name)) << name;
  for (const char* name :
       {"", "/", "tf", "/tf/", "//tf", "/a//b", "/1a", "/a/2", "/a b", "/a-b", "~/pose", "/\xC3\xA9"})
    EXPECT_FALSE(is_topic_name(name)) << name;
}

TEST(TopicName, HasAPrefixOnTheWire) { EXPECT_EQ(dds_topic_name("/odom"), "rt/odom"); }

}  // namespace
}  // namespace astro::ros2
