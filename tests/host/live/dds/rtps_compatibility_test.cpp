#include "host/live/dds/rtps_compatibility.hpp"

#include <gmock/gmock.h>

#include "host/live/dds/rtps_check.hpp"
#include "tests/support/ros2/rtps_samples.hpp"

namespace astro::dds {
namespace {

using support::bytes_in;
using support::operator+;
using support::words;
using testing::ElementsAre;
using testing::IsEmpty;

// CycloneDDS's reader 0x204 to the writer 0x903 of Fast DDS, before it has heard of it.
constexpr std::string_view kFromCyclone = "525450530201011001105eec4d1e36fad7135fec";
constexpr std::string_view kToFastDds = "0e010c00010fb0b85d73e9d200000000";
constexpr std::string_view kEndpoints = "0000020400000903";

/// First number (upper half, lower half), bits, and what follows.
Bytes acknowledgement(const Bytes& numbers) {
  const Bytes body = bytes_in(kEndpoints) + numbers;
  return bytes_in(kFromCyclone) + bytes_in(kToFastDds) +
         Bytes{0x06, 0x01, static_cast<std::uint8_t>(body.size()), 0} + body;
}

Guid guid_in(std::string_view hex) {
  Guid guid;
  std::ranges::copy(bytes_in(hex), guid.bytes.begin());
  return guid;
}
const Acknowledgement kPair{guid_in("01105eec4d1e36fad7135fec00000204"),
                            guid_in("010fb0b85d73e9d20000000000000903")};

std::optional<Bytes> for_fast_dds(ByteView datagram) {
  AcknowledgementCounts counts;
  return for_fast_dds(datagram, counts);
}

TEST(Compatibility, AReaderOfCycloneThatHasFoundAWriterSaysSoAsOneOfFastDdsDoes) {
  EXPECT_EQ(for_fast_dds(acknowledgement(words({0, 1, 0, 0}))), acknowledgement(words({0, 0, 0, 1})));
}

TEST(Compatibility, AReaderThatHasFoundItsWriterAgainIsHeardAgain) {
  AcknowledgementCounts counts;
  const auto taken = [&](const Bytes& numbers) {
    return for_fast_dds(acknowledgement(numbers), counts).value();
  };
  EXPECT_EQ(taken(words({0, 1, 0, 0})), acknowledgement(words({0, 0, 0, 1})));
  EXPECT_EQ(taken(words({0, 7, 33, 0x80000000, 1, 5})), acknowledgement(words({0, 7, 33, 0x80000000, 1, 2})));
  EXPECT_EQ(taken(words({0, 1, 0, 0})), acknowledgement(words({0, 0, 0, 3})));
  EXPECT_EQ(taken(words({0, 9, 0, 6})), acknowledgement(words({0, 9, 0, 4})));
}

TEST(Compatibility, CountsGrowHoweverManyReadersThereHaveBeen) {
  AcknowledgementCounts counts;
  EXPECT_EQ(counts.next(kPair), 1U);
  EXPECT_EQ(counts.next(kPair), 2U);
  Acknowledgement stranger = kPair;
  for (std::size_t i = 0; i < AcknowledgementCounts::kMostPairs; ++i) {
    store<std::size_t>(stranger.reader.bytes, 0, i);
    counts.next(stranger);
  }
  EXPECT_GT(counts.next(kPair), 2U);
}

TEST(Compatibility, EachSubmessageIsReadInItsByteOrder) {
  const Bytes before =
      bytes_in(kFromCyclone) + bytes_in(kToFastDds) + bytes_in("06000018") + bytes_in(kEndpoints);
  EXPECT_EQ(for_fast_dds(before + bytes_in("00000000000000010000000000000000")),
            before + bytes_in("00000000000000000000000000000001"));
}

TEST(Compatibility, WhatHasGoneIsNamedInData) {
  const Bytes farewell = bytes_in(support::kCycloneFarewell);
  const auto changed = for_fast_dds(farewell);
  ASSERT_TRUE(changed);
  EXPECT_EQ(changed->size(), farewell.size());
  std::vector<std::pair<int, int>> differences;
  for (std::size_t i = 0; i < farewell.size(); ++i)
    if (farewell[i] != changed->at(i)) differences.emplace_back(farewell[i], changed->at(i));
  ASSERT_THAT(differences, testing::Not(IsEmpty()));
  EXPECT_THAT(differences, testing::Each(std::pair(0x0b, 0x07))) << "flags: inline QoS, and a key or data";
  EXPECT_FALSE(for_fast_dds(*changed));
}

TEST(Compatibility, AllElseStaysAsItIs) {
  for (const std::string_view sample :
       {support::kFastParticipant, support::kCycloneParticipant, support::kFastRequest,
        support::kCycloneWriter, support::kCycloneMessage})
    EXPECT_FALSE(for_fast_dds(sound_part(bytes_in(sample))));
  EXPECT_FALSE(for_fast_dds({}));
}

TEST(Acknowledgements, AreNotedWithTheReaderAndTheWriterOnceItHasHeardOfIt) {
  EXPECT_THAT(acknowledgements_in(acknowledgement(words({0, 1, 0, 1}))), ElementsAre(kPair));
  EXPECT_THAT(acknowledgements_in(acknowledgement(words({0, 5, 1, 0x80000000, 9}))), ElementsAre(kPair));
}

TEST(Acknowledgements, OfAReaderThatHasOnlyFoundTheWriterDoNotCount) {
  EXPECT_THAT(acknowledgements_in(acknowledgement(words({0, 1, 0, 0}))), IsEmpty()) << "CycloneDDS";
  EXPECT_THAT(acknowledgements_in(acknowledgement(words({0, 0, 0, 1}))), IsEmpty()) << "Fast DDS";
}

TEST(Acknowledgements, ThatDoNotSayToWhomDoNotCount) {
  const Bytes body = bytes_in(kEndpoints) + words({0, 5, 0, 9});
  EXPECT_THAT(acknowledgements_in(bytes_in(kFromCyclone) + bytes_in("06011800") + body), IsEmpty());
  EXPECT_THAT(acknowledgements_in({}), IsEmpty());
}

}  // namespace
}  // namespace astro::dds
