#include "host/live/ros2/node.hpp"

#include <gmock/gmock.h>

#include <random>

#include "host/base/error.hpp"
#include "host/formats/cdr/codec.hpp"
#include "host/formats/messages/geometry.hpp"
#include "host/formats/messages/parameters.hpp"
#include "host/formats/messages/std.hpp"
#include "host/live/ros2/parameter_services.hpp"
#include "tests/host/live/ros2/fake_participant.hpp"
#include "tests/host/live/ros2/parameters_of.hpp"

namespace astro::live {
namespace {

using dds::guid_of;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;
using testing::UnorderedElementsAre;

constexpr auto kLater = GidSize::iron_and_later;

class NodeOnAFakeWire : public testing::Test {
 protected:
  void put(const std::string& topic, Bytes payload, dds::Guid writer = guid_of(0x71, 3)) {
    wire_.reader_of(topic).waiting.push_back({std::move(payload), {writer, 1}, std::nullopt});
  }
  std::vector<dds::FakeWire::Written>& written(const std::string& topic) {
    return wire_.writer_of(topic).written;
  }
  std::optional<ros2::msg::ParticipantEntitiesInfo<16>> announced() {
    node_->poll();
    const auto& all = written("ros_discovery_info");
    return all.empty() ? std::nullopt
                       : ros2::decode<ros2::msg::ParticipantEntitiesInfo<16>>(all.back().payload);
  }

  dds::FakeWire wire_;
  std::unique_ptr<Middleware> node_ =
      open_node({{"robot", "/hall"}, kLater}, std::make_unique<dds::FakeParticipant>(wire_));
};

TEST_F(NodeOnAFakeWire, ATopicHasItsNameItsTypeItsHashAndItsQualityOnTheWire) {
  const auto publisher =
      node_->advertise({"/tf_static", message_type<ros2::msg::TFMessage>(), true, true, 1});
  const dds::Topic& topic = wire_.writer_of("rt/tf_static").topic;
  EXPECT_EQ(topic.type, "tf2_msgs::msg::dds_::TFMessage_");
  EXPECT_EQ(topic.user_data,
            "typehash=RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087;");
  EXPECT_TRUE(topic.qos.reliable);
  EXPECT_TRUE(topic.qos.transient_local);
  EXPECT_EQ(topic.qos.depth, 1);
  EXPECT_FALSE(publisher->has_subscribers());
  wire_.writer_of("rt/tf_static").readers.push_back(guid_of(9, 4));
  EXPECT_TRUE(publisher->has_subscribers());
  publisher->publish(ros2::encode(ros2::msg::TFMessage{}), 0);
  EXPECT_EQ(written("rt/tf_static").at(0).payload, ros2::encode(ros2::msg::TFMessage{}));
}

// A reader with best effort never says that it has found a writer: whoever waited for that would publish nothing to it.
TEST_F(NodeOnAFakeWire, ATopicIsPublishedToAReaderThatHasNotBeenHeardYet) {
  const auto publisher = node_->advertise({"/pose", message_type<ros2::msg::TFMessage>(), true, false, 10});
  auto& end = wire_.writer_of("rt/pose");
  end.readers.push_back(guid_of(9, 4));
  end.found = false;
  EXPECT_TRUE(publisher->has_subscribers());
}

TEST_F(NodeOnAFakeWire, MessagesComeInPollUnderTheTypeOfTheirReader) {
  std::vector<std::string> came;
  node_->subscribe({"/cmd_vel", message_type<ros2::msg::Twist>()},
                   [&](ByteView) { came.emplace_back("Twist"); });
  node_->subscribe({"/cmd_vel", message_type<ros2::msg::TwistStamped>()},
                   [&](ByteView) { came.emplace_back("TwistStamped"); });
  ASSERT_THAT(wire_.readers, SizeIs(2));
  wire_.readers.back().waiting.push_back({ros2::encode(ros2::msg::TwistStamped{}), {}, {}});
  EXPECT_THAT(came, IsEmpty());
  node_->poll();
  EXPECT_THAT(came, ElementsAre("TwistStamped"));
}

TEST_F(NodeOnAFakeWire, APublisherOfATypeThatTheNodeDoesNotTakeIsToldOfOnce) {
  std::vector<std::string> told;
  node_ = open_node(
      {{"robot", "/hall"},
       kLater,
       [](const std::string&) {},
       [&](const std::string& topic, const std::string& type) { told.push_back(topic + ' ' + type); }},
      std::make_unique<dds::FakeParticipant>(wire_));
  node_->subscribe({"/cmd_vel", message_type<ros2::msg::TwistStamped>()}, [](ByteView) {});
  for (const char* type : {"geometry_msgs::msg::dds_::Twist_", "geometry_msgs::msg::dds_::TwistStamped_"}) {
    wire_.others.push_back({guid_of(0x71, 3), true, "rt/cmd_vel", type});
    wire_.others.push_back({guid_of(0x72, 4), false, "rt/cmd_vel", type});  // who only listens
    wire_.others.push_back({guid_of(0x73, 3), true, "rt/other", type});
  }
  node_->poll();
  EXPECT_THAT(told, ElementsAre("/cmd_vel geometry_msgs/msg/Twist"));
}

TEST_F(NodeOnAFakeWire, AnUrgentServiceIsAnsweredBetweenOthersThatWaitLonger) {
  std::string order;
  const auto serve = [&](const char* name, bool urgent, const std::function<void()>& work) {
    node_->serve({name, ros2::msg::Trigger::kType, message_type<ros2::msg::Trigger::Request>(),
                  message_type<ros2::msg::Trigger::Response>(), urgent},
                 [work](ByteView) { return work(), std::optional<Bytes>(); });
  };
  const dds::Sample request{ros2::encode(ros2::msg::Trigger::Request{}), {}, {}};
  // It comes while the first of three other requests is being answered.
  serve("/arm", false, [&] {
    if (order.empty()) wire_.reader_of("rq/emergency_stopRequest").waiting.push_back(request);
    order += 'a';
  });
  serve("/emergency_stop", true, [&] { order += 'E'; });
  wire_.reader_of("rq/armRequest").waiting.assign(3, request);
  node_->poll();
  EXPECT_EQ(order, "aEaa");
}

TEST_F(NodeOnAFakeWire, CallsThatTakeLongTakeTurnsAndLeaveTimeForOthersBetweenThem) {
  std::string order;
  for (const char* name : {"/a", "/b"})
    node_->serve({name, ros2::msg::Trigger::kType, message_type<ros2::msg::Trigger::Request>(),
                  message_type<ros2::msg::Trigger::Response>()},
                 [&order, name](ByteView) {
                   const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(6);
                   while (std::chrono::steady_clock::now() < until) continue;
                   order += name[1];
                   return std::optional<Bytes>();
                 });
  const dds::Sample request{ros2::encode(ros2::msg::Trigger::Request{}), {}, {}};
  wire_.reader_of("rq/aRequest").waiting.assign(3, request);
  wire_.reader_of("rq/bRequest").waiting.assign(3, request);
  node_->poll();
  EXPECT_EQ(order.size(), 1U) << "no call begins 5 ms after the first";
  for (int i = 0; i < 5; ++i) node_->poll();
  EXPECT_EQ(order, "ababab");
}

TEST_F(NodeOnAFakeWire, AnnouncesTheEndpointsOfTopicsAndServicesAsLongAsTheyAreThere) {
  auto publisher = node_->advertise({"/odom", message_type<ros2::msg::Twist>()});
  node_->subscribe({"/cmd_vel", message_type<ros2::msg::Twist>()}, [](ByteView) {});
  node_->subscribe({"/cmd_vel", message_type<ros2::msg::TwistStamped>()}, [](ByteView) {});
  node_->serve({"/arm", ros2::msg::Trigger::kType, message_type<ros2::msg::Trigger::Request>(),
                message_type<ros2::msg::Trigger::Response>()},
               [](ByteView) { return std::nullopt; });
  auto info = announced();
  ASSERT_TRUE(info);
  ASSERT_THAT(info->node_entities_info_seq, SizeIs(1));
  const auto& node = info->node_entities_info_seq[0];
  EXPECT_EQ(node.node_name.text, "robot");
  EXPECT_EQ(node.node_namespace.text, "/hall");
  EXPECT_THAT(node.reader_gid_seq, SizeIs(3)) << "both of /cmd_vel, and the requests";
  EXPECT_THAT(node.writer_gid_seq, SizeIs(2))
      << "/odom and the replies; ros_discovery_info is not the node's";
  publisher.reset();
  info = announced();
  EXPECT_THAT(info->node_entities_info_seq[0].writer_gid_seq, SizeIs(1));
}

TEST_F(NodeOnAFakeWire, AHandlerMaySubscribeAndServeInPoll) {
  node_->subscribe({"/a", message_type<ros2::msg::Twist>()}, [&](ByteView) {
    node_->subscribe({"/b", message_type<ros2::msg::Twist>()}, [](ByteView) {});
  });
  for (int i = 0; i < 3; ++i) put("rt/a", ros2::encode(ros2::msg::Twist{}));
  node_->poll();
  EXPECT_THAT(wire_.readers, SizeIs(4));
}

TEST_F(NodeOnAFakeWire, ServesParametersUnderItsFullNameAndTellsOfChanges) {
  NumbersTable table({{"b", 0.2}});
  node_->serve_parameters(table);
  for (const char* name : {"get_parameters", "get_parameter_types", "set_parameters",
                           "set_parameters_atomically", "describe_parameters", "list_parameters"})
    EXPECT_NO_THROW(wire_.reader_of(std::string("rq/hall/robot/") + name + "Request")) << name;
  put("rq/hall/robot/set_parametersRequest",
      ros2::encode(ros2::msg::SetParameters::Request{{{"b", real(0.25)}}}));
  node_->poll();
  const auto reply = ros2::decode<ros2::msg::SetParameters::Response>(
      written("rr/hall/robot/set_parametersReply").at(0).payload);
  ASSERT_TRUE(reply);
  EXPECT_TRUE(reply->results.at(0).successful);
  const auto event = ros2::decode<ros2::msg::ParameterEvent>(written("rt/parameter_events").at(0).payload);
  ASSERT_TRUE(event);
  EXPECT_EQ(event->node, "/hall/robot");
  EXPECT_THAT(event->changed_parameters, ElementsAre(ros2::msg::Parameter{"b", real(0.25)}));
  EXPECT_GT(event->stamp.sec, 1'700'000'000) << "seconds since 1970";
}

/// Those of a robot come when it was found and go with it.
class ChangingTable : public NumbersTable {
 public:
  ChangingTable() : NumbersTable({{"b", 0.2}, {"rate", 50}}) {}
  std::vector<ros2::msg::ParameterDescriptor> descriptors() override {
    auto all = NumbersTable::descriptors();
    if (!robot) all.erase(all.begin());
    return all;
  }
  bool robot = false;
};

TEST_F(NodeOnAFakeWire, TellsOfParametersThatComeAndGo) {
  ChangingTable table;
  node_->serve_parameters(table);
  const auto told = [&]() -> std::optional<ros2::msg::ParameterEvent> {
    written("rt/parameter_events").clear();
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(5);
    while (written("rt/parameter_events").empty() && std::chrono::steady_clock::now() < until) node_->poll();
    return ros2::decode<ros2::msg::ParameterEvent>(written("rt/parameter_events").at(0).payload);
  };
  EXPECT_THAT(told()->new_parameters, ElementsAre(ros2::msg::Parameter{"rate", real(50)}));
  table.robot = true;
  EXPECT_THAT(told()->new_parameters, ElementsAre(ros2::msg::Parameter{"b", real(0.2)}));
  table.robot = false;
  EXPECT_THAT(told()->deleted_parameters, ElementsAre(ros2::msg::Parameter{"b", {}}));
}

TEST_F(NodeOnAFakeWire, BadNamesAreRefused) {
  const auto open = [&](const ros2::NodeName& name) {
    return open_node({name, kLater}, std::make_unique<dds::FakeParticipant>(wire_));
  };
  EXPECT_THROW(open({"two words", "/"}), Error);
  EXPECT_THROW(open({"robot", "hall"}), Error);
  EXPECT_THROW(open_node({{"a/b"}, kLater}, dds::Discovery{}), Error);
  EXPECT_THROW(node_->advertise({"odom", message_type<ros2::msg::Twist>()}), Error);
}

/// Whatever strangers send to any of its services, a node neither fails nor answers with more than it was asked for.
TEST_F(NodeOnAFakeWire, BearsAnyBytesAsRequestsForParameters) {
  NumbersTable table({{"b", 0.2}, {"a.c", 1}});
  node_->serve_parameters(table);
  const dds::Guid cyclone = guid_of(0x81, 3);
  wire_.user_data[cyclone] = "clientid=1;";
  const Bytes honest = ros2::encode(ros2::msg::SetParameters::Request{{{"b", real(0.25)}, {"a.c", real(2)}}});
  constexpr unsigned kSeed = 20261124;
  std::mt19937 random(kSeed);
  for (int round = 0; round < 3000; ++round) {
    Bytes bytes = honest;
    for (unsigned i = 0; i < random() % 8; ++i)
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    bytes.resize(random() % 4 == 0 ? random() % bytes.size() : bytes.size());
    for (auto& reader : wire_.readers)
      reader.waiting.push_back({bytes, {random() % 2 == 0 ? cyclone : guid_of(0x71, 3), 1}, std::nullopt});
    ASSERT_NO_THROW(node_->poll()) << "seed " << kSeed << " round " << round;
  }
}

TEST_F(NodeOnAFakeWire, ARequestForVeryManyNamesIsNotAnswered) {
  NumbersTable table({{"b", 0.2}});
  node_->serve_parameters(table);
  const auto replies = [&](std::size_t names) {
    put("rq/hall/robot/describe_parametersRequest",
        ros2::encode(ros2::msg::DescribeParameters::Request{std::vector<std::string>(names, "b")}));
    node_->poll();
    return written("rr/hall/robot/describe_parametersReply").size();
  };
  EXPECT_EQ(replies(ParameterServices::kMostNames), 1U);
  EXPECT_EQ(replies(ParameterServices::kMostNames + 1), 1U);
  EXPECT_EQ(replies(100'000), 1U);
}

}  // namespace
}  // namespace astro::live
