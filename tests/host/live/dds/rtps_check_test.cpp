#include "host/live/dds/rtps_check.hpp"

#include <gmock/gmock.h>

#include <set>

#include "tests/support/ros2/rtps_samples.hpp"

namespace astro::dds {
namespace {

using support::bytes_in;
using support::operator+;
using support::words;
using testing::ElementsAreArray;
using testing::IsEmpty;

constexpr std::uint8_t kPad = 0x01, kAcknowledgement = 0x06, kHeartbeat = 0x07, kGap = 0x08, kTime = 0x09,
                       kSource = 0x0c, kReplyIp4 = 0x0d, kDestination = 0x0e, kReply = 0x0f, kMissing = 0x12,
                       kFragments = 0x13, kData = 0x15, kDataFragment = 0x16, kStatistics = 0x80;

Bytes header() {
  return bytes_in(
      "52545053"
      "0203"
      "0110"
      "000102030405060708090a0b");
}

/// `flags` besides the one for little-endian.
Bytes submessage(std::uint8_t id, const Bytes& body, std::uint8_t flags = 0) {
  Bytes bytes{id, static_cast<std::uint8_t>(flags | 1)};
  append(bytes, static_cast<std::uint16_t>(body.size()));
  return bytes + body;
}

bool accepts(std::uint8_t id, const Bytes& body, std::uint8_t flags = 0) {
  const Bytes datagram = header() + submessage(id, body, flags);
  return sound_part(datagram).size() == datagram.size();
}

/// Where the submessages of a datagram begin, and its end.
std::vector<std::size_t> borders(ByteView datagram) {
  std::vector<std::size_t> all{20};
  while (all.back() < datagram.size())
    all.push_back(all.back() + 4 + load<std::uint16_t>(datagram, all.back() + 2));
  return all;
}

class Sample : public testing::TestWithParam<std::string_view> {
 protected:
  Bytes bytes_ = bytes_in(GetParam());
};
INSTANTIATE_TEST_SUITE_P(OfBoth, Sample, testing::ValuesIn(support::kRtpsSamples));

TEST_P(Sample, IsPassedOnUpToTheFirstSubmessageOfAVendor) {
  std::size_t end = bytes_.size();
  const auto all = borders(bytes_);
  for (std::size_t i = all.size() - 1; i-- > 0;)
    if (bytes_[all[i]] >= 0x80) end = all[i];
  EXPECT_THAT(sound_part(bytes_), ElementsAreArray(ByteView(bytes_).first(end)));
}

TEST_P(Sample, IsDroppedIfASubmessageIsCut) {
  const auto all = borders(bytes_);
  const std::set<std::size_t> whole(all.begin(), all.end());
  for (std::size_t size = 0; size < bytes_.size(); ++size) {
    if (whole.contains(size)) continue;
    EXPECT_THAT(sound_part(ByteView(bytes_).first(size)), IsEmpty()) << size;
  }
}

TEST_P(Sample, IsDroppedWithBytesBehindItThatAreNoSubmessage) {
  for (int i = 0; i < 3; ++i) {
    bytes_.push_back(0);
    EXPECT_THAT(sound_part(bytes_), IsEmpty());
  }
}

// What is passed on is what a second look passes on.
TEST_P(Sample, IsSoundOnceItHasBeenJudged) {
  const ByteView sound = sound_part(bytes_);
  EXPECT_THAT(sound_part(sound), ElementsAreArray(sound));
}

TEST(Datagram, BeginsWithTheNameAndMajorVersionOfRtps) {
  const Bytes good = header() + submessage(kPad, {});
  EXPECT_FALSE(sound_part(good).empty());
  for (const std::size_t at : {0U, 1U, 2U, 3U, 4U}) {
    Bytes bad = good;
    ++bad[at];
    EXPECT_THAT(sound_part(bad), IsEmpty()) << at;
  }
  Bytes newer = good;
  newer[5] = 9;
  EXPECT_FALSE(sound_part(newer).empty()) << "of the minor version nothing depends";
  EXPECT_THAT(sound_part({}), IsEmpty());
  EXPECT_THAT(sound_part(header()), IsEmpty()) << "nothing is in it";
}

TEST(Datagram, EndsBeforeTheFirstSubmessageOfAVendor) {
  const Bytes standard = header() + submessage(kPad, {}), statistics = submessage(kStatistics, Bytes(44));
  EXPECT_THAT(sound_part(standard + statistics), ElementsAreArray(standard));
  EXPECT_THAT(sound_part(standard + submessage(kStatistics, Bytes(40))), ElementsAreArray(standard));
  EXPECT_THAT(sound_part(standard + statistics + submessage(kPad, {})), ElementsAreArray(standard));
  EXPECT_THAT(sound_part(standard + submessage(0xff, {})), ElementsAreArray(standard));
  EXPECT_THAT(sound_part(header() + statistics), IsEmpty());
  EXPECT_THAT(sound_part(standard + statistics + Bytes{kPad}), IsEmpty())
      << "what is not read is whole all the same";
}

TEST(Datagram, HasALengthOfZeroAtItsEndOnlyExceptForWhatMayBeEmpty) {
  const Bytes destination{kDestination, 1, 0, 0}, prefix(12);
  EXPECT_FALSE(sound_part(header() + destination + prefix).empty());
  EXPECT_THAT(sound_part(header() + destination), IsEmpty());
  EXPECT_FALSE(
      sound_part(header() + submessage(kPad, {}) + submessage(kTime, {}, 2) + submessage(kPad, {})).empty())
      << "these are three, not one";
  EXPECT_THAT(sound_part(header() + submessage(kTime, {})), IsEmpty())
      << "a time, unless a flag says that there is none";
}

TEST(Datagram, HasSubmessagesThatBeginAtMultiplesOfFourBytes) {
  const Bytes odd = submessage(kPad, Bytes(5));
  EXPECT_FALSE(sound_part(header() + odd).empty()) << "the last one may end anywhere";
  EXPECT_THAT(sound_part(header() + odd + submessage(kPad, {})), IsEmpty());
}

TEST(Datagram, MayHoldWhatTheStandardLeavesUndefined) { EXPECT_TRUE(accepts(0x31, Bytes(8))); }

TEST(Datagram, IsReadInTheByteOrderOfEachSubmessage) {
  const Bytes body = bytes_in(
      "00000000"
      "00000000"
      "00000000"
      "00000001"
      "00000000"
      "00000002"
      "00000007");
  const Bytes heartbeat = Bytes{kHeartbeat, 0, 0, 28} + body;
  EXPECT_FALSE(sound_part(header() + heartbeat).empty());
  EXPECT_THAT(sound_part(header() + Bytes{kHeartbeat, 1, 0, 28} + body), IsEmpty());
}

struct Short {
  std::uint8_t id;
  Bytes body;  // no field is missing
  std::uint8_t flags = 0;
};

const Bytes kEntities = words({0, 0});
const Bytes kOne = words({0, 1});  // a sequence number

class Kinds : public testing::TestWithParam<Short> {};
INSTANTIATE_TEST_SUITE_P(
    All, Kinds,
    testing::Values(Short{kAcknowledgement, kEntities + kOne + words({33, 0, 0, 7})},
                    Short{kHeartbeat, kEntities + kOne + kOne + words({7})},
                    Short{kGap, kEntities + kOne + kOne + words({1, 0})}, Short{kTime, words({0, 0})},
                    Short{kSource, Bytes(20)}, Short{kReplyIp4, Bytes(8)}, Short{kReplyIp4, Bytes(16), 2},
                    Short{kDestination, Bytes(12)}, Short{kReply, words({1}) + Bytes(24)},
                    Short{kReply, words({0, 1}) + Bytes(24), 2},
                    Short{kMissing, kEntities + kOne + words({1, 1, 0, 7})},
                    Short{kFragments, kEntities + kOne + words({1, 7})},
                    Short{kData, words({16U << 16}) + kEntities + kOne},
                    Short{kData, words({16U << 16}) + kEntities + kOne + words({0x100}), 4},
                    Short{kDataFragment,
                          words({28U << 16}) + kEntities + kOne + words({1, 4U << 16 | 1, 4, 0})}));

TEST_P(Kinds, HasAllItsFields) {
  const auto& [id, body, flags] = GetParam();
  EXPECT_TRUE(accepts(id, body, flags));
  for (std::size_t size = 1; size < body.size(); ++size)
    EXPECT_FALSE(accepts(id, Bytes(body.begin(), body.begin() + static_cast<std::ptrdiff_t>(size)), flags))
        << size;
}

TEST(SequenceNumbers, BeginWithOneAndEndWithTheLargest) {
  constexpr auto kLargest = static_cast<std::uint32_t>(kLargestNumber);
  const Bytes zero = words({0, 0}), negative = words({0xffff'ffff, 1}), large = words({0, kLargest});
  for (const Bytes& bad : {zero, negative, words({0, kLargest + 1}), words({1, 1})}) {
    EXPECT_FALSE(accepts(kHeartbeat, kEntities + bad + large + words({7})));
    EXPECT_FALSE(accepts(kGap, kEntities + bad + kOne + words({0})));
    EXPECT_FALSE(accepts(kGap, kEntities + large + bad + words({0})));
    EXPECT_FALSE(accepts(kMissing, kEntities + bad + words({1, 0, 7})));
    EXPECT_FALSE(accepts(kFragments, kEntities + bad + words({1, 7})));
    EXPECT_FALSE(accepts(kData, words({16U << 16}) + kEntities + bad));
    EXPECT_EQ(accepts(kAcknowledgement, kEntities + bad + words({0, 7})), bad == zero)
        << "Fast DDS begins with 0";
  }
  EXPECT_FALSE(accepts(kHeartbeat, kEntities + kOne + words({0, kLargest + 1, 7})));
  EXPECT_TRUE(accepts(kHeartbeat, kEntities + kOne + large + words({7})));
}

TEST(Heartbeat, NamesAFirstNumberThatIsNotBehindTheLastOne) {
  const auto heartbeat = [](std::uint32_t first, std::uint32_t last) {
    return accepts(kHeartbeat, kEntities + words({0, first, 0, last, 7}));
  };
  EXPECT_TRUE(heartbeat(1, 0)) << "nothing has been written";
  EXPECT_TRUE(heartbeat(5, 4));
  EXPECT_FALSE(heartbeat(5, 3));
}

TEST(Sets, HoldNoMoreThan256Numbers) {
  EXPECT_TRUE(accepts(kAcknowledgement, kEntities + kOne + words({256}) + Bytes(32) + words({7})));
  EXPECT_FALSE(accepts(kAcknowledgement, kEntities + kOne + words({257}) + Bytes(36) + words({7})));
  EXPECT_FALSE(accepts(kMissing, kEntities + kOne + words({1, 257}) + Bytes(36) + words({7})));
}

TEST(Gap, IsNoLongerThanItMayBe) {
  const auto gap = [](std::int64_t first, std::int64_t set) {
    const auto half = [](std::int64_t number, int shift) {
      return static_cast<std::uint32_t>(number >> shift);
    };
    return accepts(kGap,
                   kEntities + words({half(first, 32), half(first, 0), half(set, 32), half(set, 0), 0}));
  };
  EXPECT_TRUE(gap(5, 5 + kLongestGap));
  EXPECT_FALSE(gap(5, 6 + kLongestGap));
  EXPECT_TRUE(gap(5, 1)) << "of the set alone";
}

TEST(Fragments, AreCountedFromOneToTheLargest) {
  EXPECT_FALSE(accepts(kMissing, kEntities + kOne + words({0, 1, 0, 7})));
  EXPECT_FALSE(accepts(kFragments, kEntities + kOne + words({0, 7})));
  EXPECT_FALSE(accepts(kMissing, kEntities + kOne + words({kLargestFragmentedSample + 1, 1, 0, 7})));
  EXPECT_FALSE(accepts(kFragments, kEntities + kOne + words({kLargestFragmentedSample + 1, 7})));
}

Bytes fragment(std::uint32_t first, std::uint16_t count, std::uint16_t size, std::uint32_t sample,
               std::size_t payload) {
  return words({28U << 16}) + kEntities + kOne + words({first, std::uint32_t{size} << 16 | count, sample}) +
         Bytes(payload);
}

TEST(Fragments, LieInTheirSampleAndInTheSubmessage) {
  EXPECT_TRUE(accepts(kDataFragment, fragment(1, 2, 8, 20, 16)));
  EXPECT_TRUE(accepts(kDataFragment, fragment(3, 1, 8, 20, 4))) << "the last one is shorter";
  EXPECT_FALSE(accepts(kDataFragment, fragment(1, 2, 8, 20, 12)));
  EXPECT_FALSE(accepts(kDataFragment, fragment(0, 1, 8, 20, 16)));
  EXPECT_FALSE(accepts(kDataFragment, fragment(1, 0, 8, 20, 16)));
  EXPECT_FALSE(accepts(kDataFragment, fragment(1, 1, 0, 20, 16)));
  EXPECT_FALSE(accepts(kDataFragment, fragment(4, 1, 8, 20, 16)));
  EXPECT_FALSE(accepts(kDataFragment, fragment(3, 2, 8, 20, 16)));
  EXPECT_FALSE(accepts(kDataFragment, fragment(1, 1, 8, 4, 16))) << "a fragment is larger than the sample";
}

TEST(Fragments, AreOfSamplesForWhichThereIsMemory) {
  EXPECT_TRUE(accepts(kDataFragment, fragment(1, 1, 8, kLargestFragmentedSample, 8)));
  EXPECT_FALSE(accepts(kDataFragment, fragment(1, 1, 8, kLargestFragmentedSample + 1, 8)));
}

Bytes data(const Bytes& rest, std::uint32_t to_inline_qos = 16, std::uint32_t writer = 0x0201'0000) {
  return words({to_inline_qos << 16, 0, writer}) + kOne + rest;
}

constexpr std::uint32_t kEndOfList = 1;
const Bytes kPayload = words({0x100, 7});

TEST(Data, HasItsPayloadBehindTheInlineQos) {
  constexpr std::uint8_t kQos = 2, kWithPayload = 4, kWithKey = 8;
  const Bytes status = words({4U << 16 | 0x71, 0});
  EXPECT_TRUE(accepts(kData, data(status + words({kEndOfList}) + kPayload), kQos | kWithPayload));
  EXPECT_TRUE(accepts(kData, data(status + words({kEndOfList})), kQos));
  EXPECT_FALSE(accepts(kData, data(status), kQos)) << "no sentinel";
  EXPECT_FALSE(accepts(kData, data(status + words({kEndOfList})), kQos | kWithPayload)) << "no payload";
  EXPECT_FALSE(accepts(kData, data(kPayload), kWithPayload | kWithKey));
  EXPECT_FALSE(accepts(kDataFragment, fragment(1, 1, 8, 8, 8), kQos)) << "no sentinel";
}

TEST(Data, MayHaveFieldsThatANewerVersionAddsBeforeTheInlineQos) {
  EXPECT_TRUE(accepts(kData, data(words({99}) + kPayload, 20), 4));
  EXPECT_FALSE(accepts(kData, data(kPayload, 12), 4));
  EXPECT_FALSE(accepts(kData, data(kPayload, 18), 4));
  EXPECT_FALSE(accepts(kData, data(kPayload, 0x8000), 4));
  EXPECT_FALSE(accepts(kData, data({}, 20)));
}

// The bytes of an identifier in memory, read as a little-endian word.
constexpr std::uint32_t kParticipants = 0xc200'0100, kWriters = 0xc203'0000, kReaders = 0xc204'0000;

TEST(Discovery, HasAParameterListAsItsPayload) {
  const Bytes list = words({0x300, 4U << 16 | 0x15, 2, kEndOfList});
  for (const std::uint32_t writer : {kParticipants, kWriters, kReaders})
    for (const std::uint8_t flag : {std::uint8_t{4}, std::uint8_t{8}}) {
      EXPECT_TRUE(accepts(kData, data(list, 16, writer), flag));
      EXPECT_FALSE(accepts(kData, data(kPayload, 16, writer), flag));
    }
  EXPECT_FALSE(
      accepts(kDataFragment, words({28U << 16, 0, kWriters}) + kOne + words({1, 4U << 16 | 1, 4, 0})))
      << "a fragment of it cannot be judged";
}

}  // namespace
}  // namespace astro::dds
