#include "common/protocol/framer.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "common/base/crc32.hpp"
#include "common/protocol/frame.hpp"
#include "common/protocol/messages.hpp"

namespace astro::protocol {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes framed(const Bytes& body) {
  std::array<std::uint8_t, kMaxFrame> out{};
  return {out.begin(), out.begin() + static_cast<std::ptrdiff_t>(encode_frame(body, out))};
}

std::vector<Bytes> received(Framer& framer, const Bytes& stream) {
  std::vector<Bytes> bodies;
  for (const std::uint8_t byte : stream) {
    if (const auto body = framer.push(byte)) bodies.emplace_back(body->begin(), body->end());
  }
  return bodies;
}

/// What encode_frame would write, of any size: the sender that the receiver must guard against.
Bytes framed_without_limit(Bytes body) {
  const std::uint32_t crc = crc32(body);
  for (int shift = 0; shift < 32; shift += 8) body.push_back(static_cast<std::uint8_t>(crc >> shift));
  Bytes frame(cobs::max_encoded_size(body.size()));
  frame.resize(*cobs::encode(body, frame));
  frame.push_back(0);
  return frame;
}

rc::Gen<Bytes> any_body() {
  return rc::gen::mapcat(rc::gen::inRange<std::size_t>(kHeaderSize, kMaxBody + 1), [](std::size_t size) {
    return rc::gen::container<Bytes>(
        size, rc::gen::oneOf(rc::gen::just<std::uint8_t>(0), rc::gen::just<std::uint8_t>(1),
                             rc::gen::arbitrary<std::uint8_t>()));
  });
}

RC_GTEST_PROP(Framer, ReceivesEveryBodyOfAStreamHoweverItIsCut, ()) {
  const auto bodies = *rc::gen::container<std::vector<Bytes>>(any_body());
  Bytes stream;
  for (const Bytes& body : bodies) {
    stream.insert(stream.end(), *rc::gen::inRange<std::size_t>(0, 3), 0);
    const Bytes frame = framed(body);
    stream.insert(stream.end(), frame.begin(), frame.end());
  }
  Framer framer;
  std::vector<Bytes> all;
  for (std::size_t at = 0; at < stream.size();) {
    const auto size = std::min(*rc::gen::inRange<std::size_t>(1, 100), stream.size() - at);
    const auto* const from = stream.data() + at;
    for (Bytes& body : received(framer, Bytes(from, from + size))) all.push_back(std::move(body));
    at += size;
  }
  RC_ASSERT(all == bodies);
  RC_ASSERT(framer.counts().good == bodies.size());
  RC_ASSERT(framer.counts().bad() == 0U);
}

RC_GTEST_PROP(Framer, WritesOneZeroAndThatAtTheEnd, ()) {
  const Bytes frame = framed(*any_body());
  RC_ASSERT(frame.size() <= kMaxFrame);
  RC_ASSERT(std::find(frame.begin(), frame.end(), 0) == frame.end() - 1);
}

TEST(Framer, TakesBodiesUpToTheLimitAndWritesNoneBeyond) {
  Framer framer;
  for (const std::uint8_t fill : {std::uint8_t{0}, std::uint8_t{1}}) {
    EXPECT_EQ(received(framer, framed(Bytes(kMaxBody, fill))).size(), 1U);
    EXPECT_EQ(received(framer, framed(Bytes(kHeaderSize, fill))).size(), 1U);
    EXPECT_TRUE(framed(Bytes(kMaxBody + 1, fill)).empty());
    EXPECT_TRUE(framed(Bytes(kHeaderSize - 1, fill)).empty());
  }
}

TEST(Framer, CountsWhatItDropsByItsReason) {
  Framer framer;
  Bytes bad_crc = framed(Bytes(20, 5));
  bad_crc[3] = 6;
  EXPECT_TRUE(received(framer, bad_crc).empty());
  EXPECT_EQ(framer.counts().bad_crc, 1U);
  EXPECT_TRUE(received(framer, {0x09, 0x11, 0x00}).empty());
  EXPECT_EQ(framer.counts().bad_cobs, 1U);
  EXPECT_TRUE(received(framer, framed_without_limit({0x01, 0x02})).empty());
  EXPECT_EQ(framer.counts().undersize, 1U);
  EXPECT_TRUE(received(framer, framed_without_limit(Bytes(kMaxBody + 1, 0))).empty());
  EXPECT_TRUE(received(framer, framed_without_limit(Bytes(kMaxBody + 1, 1))).empty());
  EXPECT_TRUE(received(framer, framed_without_limit(Bytes(5000, 1))).empty());
  EXPECT_EQ(framer.counts().oversize, 3U);
  EXPECT_EQ(framer.counts().bad(), 6U);
  EXPECT_EQ(received(framer, {0x00, 0x00}).size(), 0U);
  EXPECT_EQ(framer.counts().bad(), 6U);
  EXPECT_EQ(received(framer, framed({1, 2, 3})).size(), 1U);
  EXPECT_EQ(framer.counts().good, 1U);
}

TEST(Framer, SurvivesNoiseAndTakesUpTheStreamAtTheNextZero) {
  constexpr std::uint32_t kSeed = 1;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  struct {
    std::array<std::uint8_t, 64> before{};
    Framer framer;
    std::array<std::uint8_t, 64> after{};
  } guarded;
  const Bytes body{1, 2, 3, 0, 5};
  Bytes good = framed(body);
  good.insert(good.begin(), 0);
  for (int round = 0; round < 2000; ++round) {
    // Rounds with few zeros overflow the buffer, rounds with many end frames at every length.
    const std::uint32_t one_zero_in = 2U << (round % 12);
    Bytes noise(random() % 1000);
    for (auto& byte : noise)
      byte = static_cast<std::uint8_t>(random() % one_zero_in == 0 ? 0 : 1 + random() % 255);
    EXPECT_TRUE(received(guarded.framer, noise).empty());
    EXPECT_EQ(received(guarded.framer, good), std::vector<Bytes>{body});
  }
  EXPECT_GT(guarded.framer.counts().oversize, 0U);
  EXPECT_EQ(guarded.before, decltype(guarded.before){});
  EXPECT_EQ(guarded.after, decltype(guarded.after){});
}

TEST(Frame, CarriesAMessageToTheOtherEnd) {
  const SegmentDone sent{.tag = 3, .outcome = SegmentOutcome::aborted, .device_time_us = 1'000'000};
  const Frame frame(sent, 0);
  Framer framer;
  const auto bodies = received(framer, Bytes(frame.bytes().begin(), frame.bytes().end()));
  ASSERT_EQ(bodies.size(), 1U);
  EXPECT_EQ(*decode<SegmentDone>(bodies[0]), sent);
}

}  // namespace
}  // namespace astro::protocol
