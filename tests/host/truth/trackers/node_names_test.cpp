#include "host/truth/trackers/node_names.hpp"

#include <gtest/gtest.h>

#include "host/formats/cdr/codec.hpp"
#include "host/formats/messages/nodes.hpp"
#include "tests/support/base/bounded.hpp"
#include "tests/support/base/mutations.hpp"

namespace astro::truth {
namespace {

namespace msg = ros2::msg;

template <std::size_t N>
msg::Gid<N> gid(std::uint8_t of) {
  msg::Gid<N> gid;
  gid.data[0] = of;
  gid.data[15] = 4;
  return gid;
}

NodeNames::Guid guid(std::uint8_t of) { return gid<16>(of).data; }

template <std::size_t N>
Bytes announcement() {
  return ros2::encode(msg::ParticipantEntitiesInfo<N>{
      gid<N>(1), {{{"/"}, {"vrpn"}, {gid<N>(2)}, {gid<N>(3)}}, {{"/lab"}, {"clock"}, {}, {gid<N>(4)}}}});
}

template <std::size_t N>
void expect_names_of() {
  NodeNames names;
  names.take(announcement<N>());
  EXPECT_EQ(names.node_of(guid(2)), "/vrpn");
  EXPECT_EQ(names.node_of(guid(3)), "/vrpn");
  EXPECT_EQ(names.node_of(guid(4)), "/lab/clock");
  EXPECT_EQ(names.node_of(guid(5)), "");
}

TEST(NodeNames, AreThoseThatHumbleAndLaterVersionsAnnounce) {
  expect_names_of<msg::kGidBytes>();
  expect_names_of<msg::kGidBytesOfHumble>();
}

TEST(NodeNames, WhatAParticipantSaysLaterReplacesWhatItSaid) {
  NodeNames names;
  names.take(announcement<16>());
  names.take(ros2::encode(msg::ParticipantEntitiesInfo<16>{gid<16>(1), {}}));
  EXPECT_EQ(names.node_of(guid(2)), "");
}

TEST(NodeNames, TakeBoundedMemoryHoweverMuchIsAnnounced) {
  const auto taken = support::measured([] {
    NodeNames names;
    msg::ParticipantEntitiesInfo<16> info{{}, {{{"/lab"}, {std::string(200, 'n')}, {}, {}}}};
    for (std::uint16_t i = 0; i < 10'000; ++i) {
      msg::Gid<16> one = gid<16>(1);
      one.data[1] = static_cast<std::uint8_t>(i);
      one.data[2] = static_cast<std::uint8_t>(i >> 8U);
      info.node_entities_info_seq[0].writer_gid_seq.push_back(one);
    }
    for (std::uint8_t i = 0; i < 12; ++i) {
      info.gid = gid<16>(i);
      names.take(ros2::encode(info));
    }
    EXPECT_EQ(names.node_of(gid<16>(1).data), "/lab/" + std::string(200, 'n'));
  });
  EXPECT_TRUE(taken.ended);
  if (support::kMeasuresMemory) {
    EXPECT_LE(taken.peak_bytes, std::size_t{16} << 20);
  }
}

TEST(NodeNames, RandomDamageNeverHarmsThem) {
  constexpr unsigned kSeed = 5;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  support::Mutator mutator(kSeed);
  NodeNames names;
  for (int i = 0; i < 5000; ++i)
    names.take(mutator.bytes(i % 2 == 0 ? announcement<16>() : announcement<24>()));
  names.take(announcement<16>());
  EXPECT_EQ(names.node_of(guid(2)), "/vrpn");
}

}  // namespace
}  // namespace astro::truth
