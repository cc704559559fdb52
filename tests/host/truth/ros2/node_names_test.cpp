#include "host/truth/ros2/node_names.hpp"

#include <gtest/gtest.h>

#include "host/ros2/cdr/codec.hpp"
#include "host/ros2/messages/graph.hpp"
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
