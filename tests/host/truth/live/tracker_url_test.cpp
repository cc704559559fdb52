#include "host/truth/live/tracker_url.hpp"

#include <gmock/gmock.h>

#include "tests/support/base/remarks.hpp"

namespace astro::truth {
namespace {

using support::Tells;
using testing::_;

Remark refusal(std::string_view text) {
  return support::told_by([&] { tracker_url_in(text); });
}

TEST(TrackerUrl, NamesHostPortBodyAndUpAxis) {
  const TrackerUrl url = tracker_url_in("vrpn://lab-pc:3884/ASTRO?up=y");
  EXPECT_EQ(url.scheme, "vrpn");
  EXPECT_EQ(url.host, "lab-pc");
  EXPECT_EQ(url.port, 3884);
  EXPECT_EQ(url.body, "ASTRO");
  EXPECT_EQ(url.up, UpAxis::y);
  EXPECT_EQ(url.place(), "lab-pc:3884");
}

TEST(TrackerUrl, LeavesPortBodyAndUpAxisToTheUsual) {
  for (const char* text : {"natnet://10.0.0.5", "natnet://10.0.0.5/"}) {
    const TrackerUrl url = tracker_url_in(text);
    EXPECT_EQ(url.scheme, "natnet");
    EXPECT_EQ(url.host, "10.0.0.5");
    EXPECT_EQ(url.port, 0);
    EXPECT_EQ(url.body, "");
    EXPECT_EQ(url.up, UpAxis::z);
  }
}

TEST(TrackerUrl, ABodysNameMayHaveAnyCharacters) {
  EXPECT_EQ(tracker_url_in("vrpn://h/my robot").body, "my robot");
  EXPECT_EQ(tracker_url_in("vrpn://h/a%3Fb%2fc").body, "a?b/c");
  EXPECT_EQ(tracker_url_in("vrpn://h/a:b").body, "a:b");
}

TEST(TrackerUrl, AnAddressOfVersion6StandsInBrackets) {
  const TrackerUrl url = tracker_url_in("vrpn://[::1]:3883/ASTRO");
  EXPECT_EQ(url.host, "::1");
  EXPECT_EQ(url.port, 3883);
  EXPECT_EQ(url.place(), "[::1]:3883");
}

TEST(TrackerUrl, WhatIsWrongIsNamed) {
  for (const char* text : {"vrpn://", "vrpn:///ASTRO"})
    EXPECT_THAT(refusal(text), Tells(UrlProblem::no_host, text));
  for (const std::string port : {"", "0", "65536", "-1", "38x3", "99999999999999999999999"})
    EXPECT_THAT(refusal("vrpn://h:" + port + "/A"), Tells(UrlProblem::port_impossible, _, port));
  EXPECT_THAT(refusal("vrpn://h/A?up=x"), Tells(UrlProblem::up_axis_unknown, _, "up=x"));
  EXPECT_THAT(refusal("vrpn://h/A?down=y"), Tells(UrlProblem::up_axis_unknown, _, "down=y"));
  EXPECT_THAT(refusal("vrpn://h/A?up=y&up=z"), Tells(UrlProblem::left_over, _, "&up=z"));
  EXPECT_THAT(refusal("vrpn://[::1/A"), Tells(UrlProblem::bracket_open));
  for (const std::string body : {"%", "%4", "%zz", "a%"})
    EXPECT_THAT(refusal("vrpn://h/" + body), Tells(UrlProblem::escape_malformed));
  EXPECT_THAT(refusal("http://h/A"), Tells(UrlProblem::scheme_unknown));
}

TEST(TrackerUrl, ATopicOfRos2HasFramesAndADomainInPlaceOfAHost) {
  const TrackerUrl url =
      tracker_url_in("ros2:/tf?parent=world&child=my%26robot/base&up=y&domain=7&range=subnet");
  EXPECT_EQ(url.scheme, "ros2");
  EXPECT_EQ(url.topic, "/tf");
  EXPECT_EQ(url.parent, "world");
  EXPECT_EQ(url.body, "my&robot/base");
  EXPECT_EQ(url.up, UpAxis::y);
  EXPECT_EQ(url.where.domain, 7);
  EXPECT_EQ(url.where.range, dds::Range::subnet);
  EXPECT_EQ(url.place(), "ROS 2");
  const TrackerUrl usual = tracker_url_in("ros2:/vrpn_mocap/robot_1/pose");
  EXPECT_EQ(usual.topic, "/vrpn_mocap/robot_1/pose");
  EXPECT_EQ(usual.body + usual.parent, "");
  EXPECT_EQ(usual.up, UpAxis::z);
  EXPECT_FALSE(usual.where.domain || usual.where.range) << "the environment says them";
}

TEST(TrackerUrl, WhatIsWrongWithATopicIsNamed) {
  for (const char* host : {"ros2://lab-pc/tf", "ros2:///tf", "ros2://"})
    EXPECT_THAT(refusal(host), Tells(UrlProblem::topic_on_host, host));
  for (const std::string topic : {"", "tf", "/", "/tf/", "/a//b", "/1a", "/a b", "/a%20b", "~/pose", "/a#b"})
    EXPECT_THAT(refusal("ros2:" + topic), Tells(UrlProblem::topic_malformed, _, topic));
  for (const std::string option : {"", "up=x", "up", "down=z", "domain=233", "domain=-1", "domain=",
                                   "range=off", "range=", "child=", "parent=", "=y", "up=y?child=a"})
    EXPECT_THAT(refusal("ros2:/tf?" + option), Tells(UrlProblem::option_unknown, _, option));
  EXPECT_THAT(refusal("ros2:/tf?up=y&up=z"), Tells(UrlProblem::option_twice, _, "up"));
  EXPECT_THAT(refusal("ros2:/tf?child=%4"), Tells(UrlProblem::escape_malformed));
}

TEST(TrackerUrl, IsToldFromTheNamesOfOtherSources) {
  EXPECT_TRUE(is_tracker_url("vrpn://h"));
  EXPECT_TRUE(is_tracker_url("natnet://h"));
  EXPECT_TRUE(is_tracker_url("ros2:/tf"));
  for (const char* text : {"sim", "manual", "vrpn", "vrpn:/h", "ros2", "/home/vrpn://"})
    EXPECT_FALSE(is_tracker_url(text)) << text;
}

}  // namespace
}  // namespace astro::truth
