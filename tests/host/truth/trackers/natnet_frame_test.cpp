#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <sstream>

#include "host/truth/trackers/natnet_frame.hpp"
#include "host/truth/trackers/natnet_models.hpp"
#include "tests/support/base/places.hpp"

namespace astro::truth::natnet {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::Pair;

constexpr Version kAll[] = {{3, 0}, {3, 1}, {4, 0}, {4, 1}, {4, 3}};

Frame some_frame() {
  Frame frame;
  frame.number = 162'734;
  frame.bodies = {{2, {0.5, 1.25, -0.75, 0, 0.5, 0, -0.875}, true}, {7, {0, 0, 0, 0, 0, 0, 0}, false}};
  frame.timestamp_s = 1356.125;
  frame.exposed_ticks = 1'416'000'000'123;
  frame.received_ticks = 1'416'000'050'000;
  frame.sent_ticks = 1'416'000'060'000;
  frame.models_changed = true;
  return frame;
}

// ---- bytes

TEST(NatNetPacket, IsAsLongAsItsHeaderSays) {
  const Bytes datagram = datagram_of(Id::frame, Bytes{1, 2, 3});
  EXPECT_EQ(datagram, (Bytes{7, 0, 3, 0, 1, 2, 3}));
  const auto packet = packet_in(datagram);
  ASSERT_TRUE(packet);
  EXPECT_EQ(packet->id, Id::frame);
  EXPECT_EQ(packet->payload.size(), 3U);
  for (std::size_t size = 0; size < datagram.size(); ++size)
    EXPECT_FALSE(packet_in(ByteView(datagram).first(size))) << size;
}

TEST(NatNetPacket, TheFirstRequestHasTheSizeOfTheVendorsLibrary) {
  EXPECT_EQ(connect_request().size(), 268U);
}

TEST(NatNetServerInfo, ComesBackFromItsBytes) {
  const ServerInfo info{"Motive", {3, 1}, 3'312'787, 1511, true, {239, 255, 42, 99}};
  const Bytes payload = payload_of(info);
  EXPECT_EQ(payload.size(), 279U) << "as Motive 2.1 sends it";
  EXPECT_EQ(server_info_in(payload), info);
  for (std::size_t size = 0; size < payload.size(); ++size)
    EXPECT_FALSE(server_info_in(ByteView(payload).first(size))) << size;
}

TEST(NatNetFrame, ComesBackFromItsBytesInEveryVersion) {
  for (const Version version : kAll)
    EXPECT_EQ(frame_in(payload_of(some_frame(), version), version), some_frame())
        << int{version.major} << '.' << int{version.minor};
}

TEST(NatNetFrame, OfVersion3HasTheBytesOfMotive) {
  Frame frame;
  frame.number = 1;
  frame.bodies = {{2, {1, 0, 0, 0, 0, 0, 1}, true}};
  const Bytes payload = payload_of(frame, {3, 0});
  ASSERT_EQ(payload.size(), 4U + 4 + 4 + 4 + 38 + 4 * 4 + 46);
  const Bytes body(payload.begin() + 16, payload.begin() + 16 + 38);
  EXPECT_EQ(body, (Bytes{2, 0, 0, 0, 0, 0, 0x80, 0x3F, 0, 0, 0, 0,    0,    0, 0, 0, 0, 0, 0,
                         0, 0, 0, 0, 0, 0, 0,    0,    0, 0, 0, 0x80, 0x3F, 0, 0, 0, 0, 1, 0}));
}

TEST(NatNetFrame, CutAtAnyByteItIsNone) {
  for (const Version version : kAll) {
    const Bytes payload = payload_of(some_frame(), version);
    for (std::size_t size = 0; size < payload.size(); ++size)
      EXPECT_FALSE(frame_in(ByteView(payload).first(size), version)) << size;
  }
}

TEST(NatNetFrame, OfANewerVersionIsReadAlthoughASectionIsUnknown) {
  Bytes payload = payload_of(some_frame(), {4, 3});
  const Bytes unknown(30, 0xAB);
  payload.insert(payload.end() - 54, unknown.begin(), unknown.end());
  EXPECT_EQ(frame_in(payload, {4, 3}), some_frame());
  EXPECT_FALSE(frame_in(payload, {4, 1})) << "that version is known whole";
}

TEST(NatNetFrame, CountsThatCannotBeRightAreRefused) {
  for (const Version version : kAll)
    for (const std::int32_t count : {-1, 1'000'000'000, INT32_MIN, INT32_MAX}) {
      Bytes payload = payload_of(some_frame(), version);
      store(payload, version >= Version{4, 1} ? 20 : 12, count);  // of the rigid bodies
      EXPECT_FALSE(frame_in(payload, version)) << count;
    }
}

TEST(NatNetFrame, GarbledItIsNoneOrHasNoMoreBodiesThanBytes) {
  constexpr unsigned kSeed = 1511;
  std::mt19937 random(kSeed);
  int refused = 0;
  for (int i = 0; i < 5000; ++i) {
    const Version version = kAll[random() % std::size(kAll)];
    Bytes payload = payload_of(some_frame(), version);
    for (int changes = 1 + static_cast<int>(random() % 4); changes > 0; --changes) {
      const auto at = static_cast<std::ptrdiff_t>(random() % payload.size());
      switch (random() % 3) {
        case 0:
          payload[static_cast<std::size_t>(at)] = static_cast<std::uint8_t>(random());
          break;
        case 1:
          payload.erase(payload.begin() + at);
          break;
        default:
          payload.insert(payload.begin() + at, static_cast<std::uint8_t>(random()));
      }
    }
    const auto frame = frame_in(payload, version);
    refused += frame ? 0 : 1;
    if (frame) {
      EXPECT_LE(frame->bodies.size() * 38, payload.size()) << "seed " << kSeed << ", number " << i;
      exposed_us(*frame, 3'312'787);
      for (const RigidBody& body : frame->bodies) is_possible(body.pose);
    }
  }
  EXPECT_GT(refused, 2000) << "of 5000, seed " << kSeed;
  EXPECT_LT(refused, 4900) << "of 5000, seed " << kSeed;
}

TEST(NatNetTime, IsTheMiddleOfTheExposureAsFarAsTheServerTellsIt) {
  Frame frame = some_frame();
  constexpr std::uint64_t kTicks = 10'000'000;
  EXPECT_EQ(exposed_us(frame, kTicks), 141'600'000'012) << "to the microsecond";
  frame.exposed_ticks = 0;
  EXPECT_EQ(exposed_us(frame, kTicks), 141'600'006'000) << "when it was sent";
  frame.sent_ticks = 0;
  EXPECT_EQ(exposed_us(frame, kTicks), 1'356'125'000) << "since the server's start";
  EXPECT_EQ(exposed_us(some_frame(), 0), 1'356'125'000);
}

TEST(NatNetTime, OfADamagedFrameIsNoTrap) {
  Frame frame;
  for (const double timestamp_s : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e300}) {
    frame.timestamp_s = timestamp_s;
    EXPECT_EQ(exposed_us(frame, 0), 0);
  }
  frame.exposed_ticks = UINT64_MAX;
  EXPECT_EQ(exposed_us(frame, 1), 0);
  EXPECT_NE(exposed_us(frame, UINT64_MAX), 0);
}

TEST(NatNetModels, NamesComeBackFromTheirBytesInEveryVersion) {
  const BodyNames names{{2, "ASTRO"}, {5, "table by the door"}};
  for (const Version version : kAll) {
    const Bytes payload = payload_of(names, version);
    EXPECT_EQ(body_names_in(payload, version), names);
    for (std::size_t size = 0; size < payload.size(); ++size)
      body_names_in(ByteView(payload).first(size), version);
  }
  EXPECT_FALSE(body_names_in({}, {3, 0}));
  EXPECT_FALSE(body_names_in(Bytes{0xFF, 0xFF, 0xFF, 0xFF}, {3, 0}));
}

TEST(NatNetModels, UnknownKindsAreSkippedWhereTheirSizeIsTold) {
  const BodyNames names{{2, "ASTRO"}};
  const Bytes plate{3, 0, 0, 0, 2, 0, 0, 0, 0xAA, 0xBB};  // kind, size, content
  Bytes payload = payload_of(names, {4, 1});
  payload[0] = 2;
  payload.insert(payload.begin() + 4, plate.begin(), plate.end());
  EXPECT_EQ(body_names_in(payload, {4, 1}), names);
}

// ---- recordings of Motive 2.1, which are beside a developer's checkout

class NatNetOfMotive : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(folder_)) GTEST_SKIP() << "not at hand: " << folder_;
  }
  Bytes file(const char* name) const {
    std::ifstream file(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  /// The content of each frame in the recorded traffic: blocks of a pcapng file with IPv4 and UDP inside.
  std::vector<Frame> frames() const {
    const Bytes traffic = file("traffic_v3.pcapng");
    std::vector<Frame> frames;
    for (ByteCursor blocks(traffic); blocks.left() >= 12;) {
      const auto kind = blocks.number<std::uint32_t>(), size = blocks.number<std::uint32_t>();
      ByteCursor block(blocks.take(size - 8));
      if (kind != 6) continue;  // a packet
      block.take(12);
      const auto captured = block.number<std::uint32_t>();
      block.take(4);
      const ByteView packet = block.take(captured);
      constexpr std::size_t kHeaders = 14 + 20 + 8;  // of Ethernet, IPv4 without options, UDP
      if (packet.size() <= kHeaders || packet[14] != 0x45 || packet[23] != 17) continue;
      const auto inside = packet_in(packet.subspan(kHeaders));
      if (!inside || inside->id != Id::frame) continue;
      const auto frame = frame_in(inside->payload, {3, 0});
      EXPECT_TRUE(frame);
      if (frame) frames.push_back(*frame);
    }
    return frames;
  }

  fs::path folder_ = support::shared_data() / "samples/natnet";
};

TEST_F(NatNetOfMotive, ServerAndModelsAreRead) {
  const Bytes server = file("serverinfo_packet_v3.bin"), models = file("modeldef_packet_v3.bin");
  const auto info = server_info_in(packet_in(server)->payload);
  ASSERT_TRUE(info);
  EXPECT_EQ(info->application, "Motive");
  EXPECT_EQ(info->version, (Version{3, 0}));
  EXPECT_EQ(info->ticks_per_s, 3'312'787U);
  EXPECT_EQ(info->data_port, 1511);
  EXPECT_TRUE(info->multicast);
  EXPECT_THAT(info->group, ElementsAre(239, 255, 42, 99));
  EXPECT_THAT(*body_names_in(packet_in(models)->payload, {3, 0}), ElementsAre(Pair(2, "RaceQuad")));
}

TEST_F(NatNetOfMotive, AllFramesAreThoseThatTheVendorsClientPrinted) {
  std::map<int, Frame> by_number;
  const std::vector<Frame> all = frames();
  EXPECT_EQ(all.size(), 518U);
  for (const Frame& frame : all) by_number[frame.number] = frame;
  const Bytes log = file("SampleClient_output.txt");
  std::istringstream lines{std::string(as_text(log))};
  int compared = 0, id = 0, valid = 0;
  const Frame* frame = nullptr;
  bool values_follow = false;
  for (std::string line; std::getline(lines, line);) {
    int number = 0;
    float error = 0;
    if (std::sscanf(line.c_str(), "FrameID : %d", &number) == 1) {
      ASSERT_TRUE(by_number.contains(number)) << number;
      frame = &by_number[number];
    } else if (std::sscanf(line.c_str(), "Rigid Body [ID=%d  Error=%f  Valid=%d]", &id, &error, &valid) ==
               3) {
      std::getline(lines, line);  // the heads of the columns
      values_follow = true;
    } else if (values_follow) {
      values_follow = false;
      double v[7] = {};
      ASSERT_EQ(std::sscanf(line.c_str(), "%lf %lf %lf %lf %lf %lf %lf", &v[0], &v[1], &v[2], &v[3], &v[4],
                            &v[5], &v[6]),
                7);
      ASSERT_EQ(frame->bodies.size(), 1U);
      const RigidBody& body = frame->bodies[0];
      EXPECT_EQ(body.id, id);
      EXPECT_EQ(body.tracked, valid != 0);
      const Pose3& p = body.pose;
      const double ours[7] = {p.x_m, p.y_m, p.z_m, p.qx, p.qy, p.qz, p.qw};
      for (int i = 0; i < 7; ++i) EXPECT_NEAR(ours[i], v[i], 0.00501) << "printed with two decimals";
      ++compared;
    }
  }
  EXPECT_EQ(compared, 251);
}

TEST_F(NatNetOfMotive, TheExposuresFollowEachOtherEvenly) {
  std::vector<double> intervals_ms;
  const std::vector<Frame> all = frames();
  for (std::size_t i = 1; i < all.size(); ++i)
    if (all[i].number == all[i - 1].number + 1)
      intervals_ms.push_back(
          1e-3 * static_cast<double>(exposed_us(all[i], 3'312'787) - exposed_us(all[i - 1], 3'312'787)));
  ASSERT_GT(intervals_ms.size(), 400U);
  double mean = 0;
  for (const double interval : intervals_ms) mean += interval / static_cast<double>(intervals_ms.size());
  EXPECT_NEAR(mean, 1000.0 / 120, 0.01);
}

}  // namespace
}  // namespace astro::truth::natnet
