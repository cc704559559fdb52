#include "host/live/ros2/discovery_info.hpp"

#include <gmock/gmock.h>

#include "host/formats/cdr/codec.hpp"
#include "tests/host/live/ros2/fake_participant.hpp"

namespace astro::live {
namespace {

using dds::guid_of;
using testing::ElementsAre;
using testing::SizeIs;

const ros2::NodeName kNode{"robot", "/"};
const Endpoints kEndpoints{{guid_of(2, 4)}, {guid_of(3, 3), guid_of(4, 3)}};

void append_gid(Bytes& bytes, std::uint8_t number, std::uint8_t kind, std::size_t padding) {
  append(bytes, Bytes(15, number));
  bytes.push_back(kind);
  append(bytes, Bytes(padding, 0));
}

/// As rmw_dds_common's type support writes it, field by field.
Bytes expected(std::size_t padding) {
  Bytes bytes{0, 1, 0, 0};
  append_gid(bytes, 1, 0xC1, padding);
  append(bytes, Bytes{1, 0, 0, 0, 2, 0, 0, 0, '/', 0, 0, 0, 6, 0, 0, 0, 'r', 'o', 'b', 'o', 't', 0, 0, 0});
  append(bytes, Bytes{1, 0, 0, 0});
  append_gid(bytes, 2, 4, padding);
  append(bytes, Bytes{2, 0, 0, 0});
  append_gid(bytes, 3, 3, padding);
  append_gid(bytes, 4, 3, padding);
  return bytes;
}

TEST(DiscoveryInfo, IsForLaterDistributionsWithIdentifiersOf16Bytes) {
  EXPECT_EQ(discovery_info(guid_of(1, 0xC1), kNode, kEndpoints, GidSize::iron_and_later), expected(0));
}

TEST(DiscoveryInfo, IsForHumbleWithIdentifiersOf24Bytes) {
  EXPECT_EQ(discovery_info(guid_of(1, 0xC1), kNode, kEndpoints, GidSize::humble), expected(8));
}

TEST(DiscoveryInfo, IsToldAnewWheneverEndpointsChangeAndNotOtherwise) {
  dds::FakeWire wire;
  dds::FakeParticipant participant(wire);
  DiscoveryInfo info(participant, kNode, GidSize::iron_and_later);
  auto& writer = wire.writer_of("ros_discovery_info");
  EXPECT_TRUE(writer.topic.qos.reliable);
  EXPECT_TRUE(writer.topic.qos.transient_local);
  EXPECT_EQ(writer.topic.qos.depth, 1);
  EXPECT_EQ(writer.topic.type, "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_");
  const auto told = [&] {
    info.publish_changes();
    return writer.written.size();
  };
  EXPECT_EQ(told(), 1U) << "a node without endpoints is one, too";
  info.add_reader(guid_of(2, 4));
  info.add_writer(guid_of(3, 3));
  EXPECT_EQ(told(), 2U);
  EXPECT_EQ(told(), 2U);
  info.remove_writer(guid_of(3, 3));
  EXPECT_EQ(told(), 3U);
  EXPECT_EQ(writer.written.back().payload,
            discovery_info(participant.guid(), kNode, {{guid_of(2, 4)}, {}}, GidSize::iron_and_later));
}

}  // namespace
}  // namespace astro::live
