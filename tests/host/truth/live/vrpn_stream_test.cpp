#include "host/truth/live/vrpn_stream.hpp"

#include <gmock/gmock.h>

#include "host/truth/trackers/vrpn_tracker.hpp"
#include "tests/support/base/bounded.hpp"

namespace astro::truth {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

/// The bytes of a server.
class ServerBytes {
 public:
  explicit ServerBytes(VrpnStream& stream) : stream_(stream) {}

  void greet() { stream_.push(vrpn::cookie(), 0); }
  void describe(std::int32_t id, const std::string& body) {
    Bytes bytes;
    vrpn::append_description(bytes, vrpn::kSenderDescription, id, body, 0);
    vrpn::append_description(bytes, vrpn::kTypeDescription, 4, vrpn::kPoseType, 0);
    vrpn::append_description(bytes, vrpn::kTypeDescription, 5, "vrpn_Tracker Velocity", 0);
    stream_.push(bytes, 0);
  }
  void pose(std::int32_t id, double x_m, std::int64_t sent_us = 0, std::int64_t arrival_us = 0,
            int sensor = 0, std::int32_t type = 4) {
    Bytes bytes;
    const Bytes payload = vrpn::payload_of({sensor, {x_m, 0, 0, 0, 0, 0, 1}});
    vrpn::append(bytes, {sent_us, id, type, 0, payload});
    stream_.push(bytes, arrival_us);
  }

 private:
  VrpnStream& stream_;
};

TEST(VrpnStream, GivesThePosesOfTheNamedBodyWithBothTimes) {
  VrpnStream stream("ASTRO");
  ServerBytes server(stream);
  server.greet();
  server.describe(1, "TABLE");
  server.describe(2, "ASTRO");
  server.pose(1, 10);
  server.pose(2, 20, 1'700'000'000'000'001, 77);
  const auto sightings = stream.take();
  ASSERT_THAT(sightings, SizeIs(1));
  EXPECT_EQ(sightings[0].pose.x_m, 20);
  EXPECT_EQ(sightings[0].stamp.sender_us, 1'700'000'000'000'001);
  EXPECT_EQ(sightings[0].stamp.arrival_us, 77);
  EXPECT_THAT(stream.take(), IsEmpty());
  EXPECT_EQ(stream.why_silent(), "");
}

TEST(VrpnStream, TakesBoundedMemoryFromAServerThatGivesAnIdANewNameBeforeEachPose) {
  const auto taken = support::measured([] {
    VrpnStream stream("ASTRO");
    ServerBytes server(stream);
    server.greet();
    for (int i = 0; i < 100'000; ++i) {
      server.describe(2, std::to_string(i) + std::string(900, 'x'));
      server.pose(2, i);
    }
    server.describe(3, "ASTRO");
    EXPECT_NE(stream.why_silent(), "");
    server.pose(3, 1);
    EXPECT_EQ(stream.why_silent(), "") << "the body is seen, however many others there are";
    EXPECT_THAT(stream.take(), SizeIs(1));
  });
  EXPECT_BOUNDED(taken, 0);
}

TEST(VrpnStream, KeepsTheNewestPosesIfNobodyTakesThem) {
  const auto taken = support::measured([] {
    VrpnStream stream("ASTRO");
    ServerBytes server(stream);
    server.greet();
    server.describe(2, "ASTRO");
    for (int i = 0; i < 1'000'000; ++i) server.pose(2, i);
    const auto sightings = stream.take();
    ASSERT_FALSE(sightings.empty());
    EXPECT_LE(sightings.size(), Waiting<Sighting>::kMost);
    EXPECT_EQ(sightings.back().pose.x_m, 999'999);
  });
  EXPECT_TRUE(taken.ended);
  if (support::kMeasuresMemory) {
    EXPECT_LE(taken.peak_bytes, std::size_t{16} << 20);
  }
}

TEST(VrpnStream, LeavesOutOtherMessagesOtherSensorsAndIdsThatNobodyHasDescribed) {
  VrpnStream stream("ASTRO");
  ServerBytes server(stream);
  server.greet();
  server.pose(2, 1);  // before its description
  server.describe(2, "ASTRO");
  server.pose(2, 2, 0, 0, 1);     // another sensor
  server.pose(2, 3, 0, 0, 0, 5);  // a velocity
  server.pose(2, 4, 0, 0, 0, 9);  // unknown
  EXPECT_THAT(stream.take(), IsEmpty());
}

TEST(VrpnStream, WithoutANameTakesTheFirstBodyAndTellsOfTheOthers) {
  VrpnStream stream("");
  ServerBytes server(stream);
  server.greet();
  server.describe(1, "TABLE");
  server.describe(2, "ASTRO");
  server.pose(2, 20);
  EXPECT_THAT(stream.take(), SizeIs(1));
  EXPECT_EQ(stream.body(), "ASTRO");
  EXPECT_THAT(stream.senders(), ElementsAre("ASTRO"));
  server.pose(1, 10);
  EXPECT_THAT(stream.take(), IsEmpty());
  EXPECT_THAT(stream.senders(), ElementsAre("ASTRO", "TABLE"));
}

TEST(VrpnStream, ABodyThatIsSwitchedOnLaterIsFound) {
  VrpnStream stream("ASTRO");
  ServerBytes server(stream);
  server.greet();
  server.describe(1, "TABLE");
  EXPECT_NE(stream.why_silent(), "");
  server.describe(7, "ASTRO");
  server.pose(7, 1);
  EXPECT_THAT(stream.take(), SizeIs(1));
}

TEST(VrpnStream, SilenceHasALikelyCause) {
  VrpnStream stream("ASTRO"), any("");
  ServerBytes server(stream), any_server(any);
  EXPECT_EQ(stream.why_silent(), "it has not answered as a VRPN server");
  server.greet();
  any_server.greet();
  EXPECT_EQ(stream.why_silent(), "it has described no body");
  server.describe(1, "TABLE");
  server.describe(3, "astro");
  any_server.describe(1, "TABLE");
  EXPECT_EQ(stream.why_silent(), "it knows no 'ASTRO'; it has described 'TABLE', 'astro'");
  EXPECT_EQ(any.why_silent(), "it has described 'TABLE' and sent no pose");
  server.describe(2, "ASTRO");
  EXPECT_EQ(stream.why_silent(), "it knows 'ASTRO' but sends no pose of it");
  server.pose(1, 0);
  EXPECT_EQ(stream.why_silent(), "it knows 'ASTRO' but sends no pose of it; it sends poses of 'TABLE'");
}

TEST(VrpnStream, OfManyBodiesTwentyAreListed) {
  VrpnStream stream("ASTRO");
  ServerBytes server(stream);
  server.greet();
  for (int i = 10; i < 35; ++i) server.describe(i, "body" + std::to_string(i));
  EXPECT_THAT(stream.why_silent(), testing::EndsWith("'body28', 'body29' and 5 more"));
}

}  // namespace
}  // namespace astro::truth
