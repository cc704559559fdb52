#include "host/truth/live/ros_link.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <functional>
#include <memory>

#include "host/base/error.hpp"
#include "host/formats/cdr/codec.hpp"
#include "host/formats/cdr/type_description.hpp"
#include "host/formats/messages/geometry.hpp"
#include "host/formats/messages/nodes.hpp"
#include "host/live/dds/fast_dds.hpp"
#include "host/truth/live/listening_link.hpp"
#include "host/truth/live/live_source.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/ros2/domain.hpp"

// A publisher of ROS 2 and our link to it, over loopback.
namespace astro::truth {
namespace {

namespace dds = dds;
namespace msg = ros2::msg;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using support::ThrowsTelling;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr auto kLong = std::chrono::seconds(10);  // only a failure waits so long
constexpr dds::Qos kReliable{true, false, 10}, kBestEffort{false, false, 10}, kLatched{true, true, 1};

std::unique_ptr<dds::Participant> open_participant() {
  return dds::open_fast_dds({support::test_domain()}, "tracker", "enclave=/;");
}

/// A node that publishes messages of one type on one topic.
template <class M>
class Publisher {
 public:
  Publisher(dds::Participant& participant, const std::string& topic, dds::Qos qos = kReliable)
      : writer_(participant.create_writer({"rt" + topic, ros2::dds_type_name(M::kType), qos})) {}

  void publish(const M& message) { writer_->write(ros2::encode(message)); }
  dds::Guid guid() const { return writer_->guid(); }

 private:
  std::unique_ptr<dds::Writer> writer_;
};

msg::PoseStamped pose_at(double x_m, std::int64_t time_ns = 0, const std::string& frame = "world") {
  return {{msg::to_time(time_ns), frame}, {{x_m, 0, 0}, {0, 0, 0.6, 0.8}}};
}
msg::TransformStamped placed(const std::string& parent, const std::string& child, double x_m) {
  return {{{}, parent}, child, {{x_m, 0, 0}, {}}};
}

std::unique_ptr<RosLink> open_link_to(const std::string& address) {
  return std::make_unique<RosLink>(tracker_url_in("ros2:" + address), dds::Discovery{support::test_domain()});
}

/// Calls at most a hundred times a second.
class Periodically {
 public:
  explicit Periodically(std::function<void()> call) : call_(std::move(call)) {}
  void operator()() {
    const microseconds now = LiveSource::steady_now();
    if (now - called_at_ < milliseconds(10)) return;
    called_at_ = now;
    call_();
  }

 private:
  std::function<void()> call_;
  microseconds called_at_{};
};

/// Works the link, and `publish`es a hundred times a second, until it is done.
bool eventually(
    RosLink& link, const std::function<bool()>& done, const std::function<void()>& publish = [] {}) {
  const microseconds begin = LiveSource::steady_now();
  Periodically tracker(publish);
  while (!done()) {
    if (LiveSource::steady_now() - begin > kLong) return false;
    tracker();
    link.work(LiveSource::steady_now());
    link.wait(milliseconds(10));
  }
  return true;
}

/// All that comes until there is something.
std::vector<Sighting> sightings_of(RosLink& link, const std::function<void()>& publish) {
  std::vector<Sighting> sightings;
  EXPECT_TRUE(eventually(
      link, [&] { return !(sightings = link.take()).empty(); }, publish))
      << link.why_silent();
  return sightings;
}

TEST(RosLink, ReadsReliablePublishersAndThoseOfBestEffort) {
  for (const dds::Qos& qos : {kReliable, kBestEffort}) {
    const auto participant = open_participant();
    Publisher<msg::PoseStamped> tracker(*participant, "/mocap/pose", qos);
    const auto link = open_link_to("/mocap/pose");
    const microseconds before = LiveSource::steady_now();
    const auto sightings = sightings_of(*link, [&] { tracker.publish(pose_at(5, 1'000'001'000)); });
    EXPECT_EQ(sightings.front().pose, (Pose3{5, 0, 0, 0, 0, 0.6, 0.8}));
    EXPECT_EQ(sightings.front().stamp.sender_us, 1'000'001);
    EXPECT_GE(sightings.front().stamp.arrival_us, before.count());
    EXPECT_EQ(link->body(), "/mocap/pose");
    EXPECT_EQ(link->way(), "as geometry_msgs/msg/PoseStamped in 'world' by a participant without a node");
    EXPECT_EQ(link->why_silent(), "");
  }
}

TEST(RosLink, FindsOutOfWhichTypeTheTopicIs) {
  const auto participant = open_participant();
  Publisher<msg::Odometry> tracker(*participant, "/truth");
  const auto link = open_link_to("/truth");
  const auto sightings = sightings_of(*link, [&] {
    tracker.publish({{{}, "world"}, "robot", {{{7, 0, 0}, {}}, {}}, {}});
  });
  EXPECT_EQ(sightings.front().pose.x_m, 7);
  EXPECT_EQ(link->body(), "robot");
  EXPECT_THAT(link->way(), HasSubstr("as nav_msgs/msg/Odometry in 'world'"));
}

TEST(RosLink, AFixedTransformFromBeforeItsTimeIsPartOfTheChain) {
  const auto participant = open_participant();
  Publisher<msg::TFMessage> fixed(*participant, "/tf_static", kLatched), tf(*participant, "/tf");
  fixed.publish({{placed("markers", "base_link", -0.25)}});
  const auto link = open_link_to("/tf?parent=world&child=base_link");
  const auto sightings = sightings_of(*link, [&] { tf.publish({{placed("world", "markers", 2)}}); });
  EXPECT_EQ(sightings.front().pose.x_m, 1.75);
}

TEST(RosLink, APublisherThatComesLaterIsFoundAndOneThatStartsAnewIsAnotherConnection) {
  const auto link = open_link_to("/pose");
  link->work(LiveSource::steady_now());
  EXPECT_EQ(link->connections(), 0);
  for (const int connection : {1, 2}) {
    const auto participant = open_participant();
    Publisher<msg::PoseStamped> tracker(*participant, "/pose");
    sightings_of(*link, [&] { tracker.publish(pose_at(connection)); });
    EXPECT_EQ(link->connections(), connection);
  }
}

TEST(RosLink, APublisherMayComeBackWithAnotherType) {
  const auto link = open_link_to("/pose");
  {
    const auto participant = open_participant();
    Publisher<msg::PoseStamped> tracker(*participant, "/pose");
    sightings_of(*link, [&] { tracker.publish(pose_at(1)); });
  }
  const auto participant = open_participant();
  Publisher<msg::TransformStamped> tracker(*participant, "/pose");
  const auto changed = [&] { return link->connections() == 2; };
  EXPECT_TRUE(eventually(*link, changed, [&] { tracker.publish(placed("world", "", 3)); }));
}

TEST(RosLink, TwoPublishersAtOnceAreAnError) {
  const auto participant = open_participant(), other = open_participant();
  Publisher<msg::PoseStamped> tracker(*participant, "/pose"), filter(*other, "/pose");
  const auto link = open_link_to("/pose");
  const auto work = [&] {
    eventually(
        *link, [] { return false; },
        [&] {
          tracker.publish(pose_at(1));
          filter.publish(pose_at(2));
        });
  };
  const std::string node = "a participant without a node";
  EXPECT_THAT(work, ThrowsTelling(TopicProblem::two_publishers, "/pose", "/pose", node, node));
}

TEST(RosLink, NamesTheNodeThatPublishesAndWhetherItDrivesTheRobot) {
  const auto participant = open_participant();
  Publisher<msg::PoseStamped> tracker(*participant, "/pose");
  const auto node = participant->create_writer(
      {"ros_discovery_info", "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_", {true, true, 1}});
  node->write(ros2::encode(msg::ParticipantEntitiesInfo<16>{
      {participant->guid().bytes}, {{{"/lab"}, {"base"}, {}, {{tracker.guid().bytes}}}}}));
  const auto link = open_link_to("/pose");
  const auto named = [&] { return link->way().find("by the node /lab/base") != std::string::npos; };
  EXPECT_TRUE(eventually(*link, named, [&] { tracker.publish(pose_at(1)); })) << link->way();
  EXPECT_THAT(link->way(), testing::Not(HasSubstr("cmd_vel")));
  const auto drives = participant->create_reader({"rt/cmd_vel", ros2::dds_type_name(msg::Twist::kType)});
  const auto warned = [&] { return link->way().find("which also takes /cmd_vel") != std::string::npos; };
  EXPECT_TRUE(eventually(*link, warned)) << link->way();
}

TEST(RosLink, TheRobotsOwnOdometryIsRefused) {
  const auto participant = open_participant();
  Publisher<msg::Odometry> robot(*participant, "/odom");
  const auto link = open_link_to("/odom");
  const auto work = [&] {
    eventually(
        *link, [] { return false; },
        [&] {
          robot.publish({{{}, "odom"}, "base_footprint", {}, {}});
        });
  };
  EXPECT_THAT(work, ThrowsTelling(PoseProblem::in_odometry_frame, "/odom", "odom"));
}

/// What the link says once it says this.
void expect_reason(RosLink& link, const std::string& reason) {
  EXPECT_TRUE(eventually(link, [&] { return link.why_silent() == reason; })) << link.why_silent();
}

/// What a link to /pose says that nobody publishes, in a domain with these topics.
std::string nobody_publishes(const std::string& topics) {
  return "nobody publishes /pose in the domain " + std::to_string(support::test_domain()) +
         " of this computer; " + topics +
         "; only this computer is looked at: for others put range=subnet behind the ? of the tracker's "
         "address, or set ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET";
}

TEST(RosLink, WithoutPosesItSaysWhatIsThereInstead) {
  const auto link = open_link_to("/pose");
  expect_reason(*link, nobody_publishes("there are no topics with poses"));
  const auto participant = open_participant();
  Publisher<msg::PoseStamped> others(*participant, "/mocap/table");
  Publisher<msg::Twist> no_poses(*participant, "/twist");
  expect_reason(*link, nobody_publishes("poses are on /mocap/table (geometry_msgs/msg/PoseStamped)"));
  expect_reason(*open_link_to("/twist"),
                "/twist is of the type geometry_msgs/msg/Twist, which holds no poses");
  const auto silent = open_link_to("/mocap/table");
  expect_reason(*silent, "a participant without a node publishes /mocap/table, but no message has come");
}

TEST(RosLink, HostileBytesAreCountedAndPosesBehindThemAreRead) {
  const auto participant = open_participant();
  const auto hostile =
      participant->create_writer({"rt/pose", ros2::dds_type_name(msg::PoseStamped::kType), kReliable});
  const auto link = open_link_to("/pose");
  const auto counted = [&] { return link->why_silent().find("and none fits its type") != std::string::npos; };
  EXPECT_TRUE(eventually(*link, counted, [&] {
    hostile->write(Bytes{0, 1, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 0xFF, 0xFF, 0xFF, 0xFF});
    hostile->write(Bytes(200'000, 0xFF));
  }));
  sightings_of(*link, [&] { hostile->write(ros2::encode(pose_at(1))); });
}

/// A tracker that publishes while a source listens.
class PublishingLink : public TrackerLink {
 public:
  PublishingLink(std::unique_ptr<RosLink> link, std::function<void()> publish)
      : link_(std::move(link)), publish_(std::move(publish)) {}
  void work(microseconds now) override {
    publish_();
    link_->work(now);
  }
  void wait(microseconds) override { link_->wait(milliseconds(10)); }
  std::vector<Sighting> take() override { return link_->take(); }
  std::string why_silent() const override { return link_->why_silent(); }
  std::vector<std::string> bodies() const override { return link_->bodies(); }
  const std::string& body() const override { return link_->body(); }
  std::string way() const override { return link_->way(); }
  int connections() const override { return link_->connections(); }

 private:
  std::unique_ptr<RosLink> link_;
  Periodically publish_;
};

std::unique_ptr<LiveSource> source_of(const std::string& address, std::function<void()> publish) {
  auto link = std::make_unique<PublishingLink>(open_link_to(address), std::move(publish));
  return std::make_unique<LiveSource>(
      tracker_url_in("ros2:" + address),
      std::make_unique<ListeningLink>(std::move(link), LiveSource::steady_now), LiveSource::steady_now);
}

TEST(RosLink, IsASourceOfGroundTruthByThePublishersClockOrThatOfArrival) {
  for (const bool stamped : {true, false}) {
    const auto participant = open_participant();
    Publisher<msg::PoseStamped> tracker(*participant, "/pose");
    double x_m = 0;
    const auto source = source_of("/pose", [&] {
      const std::int64_t now_us = LiveSource::steady_now().count();
      tracker.publish(pose_at(x_m += 1e-3, stamped ? 1000 * now_us : 0));
    });
    EXPECT_EQ(source->name(), "ros2");
    EXPECT_THAT(source->description(),
                testing::StartsWith("'/pose' from ROS 2 as geometry_msgs/msg/PoseStamped in 'world' by "));
    EXPECT_THAT(source->description(),
                HasSubstr(stamped ? "times by the tracker's clock" : "times of arrival"));
    source->begin_run();
    std::vector<recording::TruthSample> samples;
    const microseconds begin = LiveSource::steady_now();
    while (samples.size() < 20 && LiveSource::steady_now() - begin < kLong)
      for (const auto& sample : source->poll()) samples.push_back(sample);
    ASSERT_GE(samples.size(), 20U);
    for (const auto& sample : samples) EXPECT_TRUE(sample.valid);
  }
}

TEST(RosLink, ASourceWithoutAPublisherSaysWhereElseOneMayBe) {
  EXPECT_THAT([] { source_of("/pose", [] {}); },
              ThrowsTelling(LiveProblem::tracker_silent, "ROS 2",
                            nobody_publishes("there are no topics with poses")));
}

}  // namespace
}  // namespace astro::truth
