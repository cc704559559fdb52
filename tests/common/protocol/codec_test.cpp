#include "common/protocol/codec.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "common/protocol/messages.hpp"
#include "tests/common/protocol/body_of.hpp"

namespace astro::protocol {

namespace {

// Arbitrary messages for property tests, drawn field by field from the schema. Only within a running property.

template <std::integral T>
void draw(T& value) {
  value = *rc::gen::arbitrary<T>();
}

template <Named E>
void draw(E& value) {
  value = static_cast<E>(*rc::gen::inRange<std::size_t>(0, names(E{}).size()));
}

template <std::size_t N>
void draw(std::array<std::uint8_t, N>& bytes) {
  bytes = *rc::gen::container<std::array<std::uint8_t, N>>(rc::gen::arbitrary<std::uint8_t>());
}

template <std::size_t N>
void draw(Text<N>& text) {
  text = Text<N>(*rc::gen::resize(static_cast<int>(2 * N), rc::gen::string<std::string>()));
}

template <detail::Record T>
void draw(T& record) {
  detail::each<false, T>([&](const auto& field) { draw(record.*field.member); });
  if constexpr (requires { record.fields; } && detail::group_mask<T>() != 0) {
    record.fields &= detail::group_mask<T>();
  }
  detail::each<true, T>([&](const auto& group) {
    if (detail::has(record, group.bit)) draw(record.*group.member);
  });
}

template <Message M>
M arbitrary() {
  M message;
  draw(message);
  return message;
}

using tests::body_of;
using Bytes = std::vector<std::uint8_t>;

// RapidCheck's templates compiled once, not once for each message.
bool holds(const std::function<void()>& property) { return rc::check(property); }
void require(bool held, const char* claim) {
  if (!held) RC_FAIL(claim);
}
std::size_t any_below(std::size_t begin, std::size_t end) { return *rc::gen::inRange(begin, end); }
template <class Value>
Value any() {
  return *rc::gen::arbitrary<Value>();
}

template <class... Lists>
struct TypesOf;
template <class... A, class... B, class... C>
struct TypesOf<MessageList<A...>, MessageList<B...>, MessageList<C...>> {
  using Types = ::testing::Types<A..., B..., C...>;
};

struct MessageName {
  template <class M>
  static std::string GetName(int) {
    return std::string(M::kName);
  }
};

template <class M>
class EveryMessage : public ::testing::Test {};
using AllTypes = TypesOf<Requests, Replies, Events>::Types;
TYPED_TEST_SUITE(EveryMessage, AllTypes, MessageName);

TYPED_TEST(EveryMessage, ComesBackAsItWasSent) {
  EXPECT_TRUE(holds([] {
    const auto sent = arbitrary<TypeParam>();
    const auto request_id = any<std::uint16_t>();
    const Bytes body = body_of(sent, request_id);
    const auto received = decode<TypeParam>(body);
    require(received.ok(), "it is read");
    require(*received == sent, "the message is the same");
    require(*peek(body) == Header{TypeParam::kId, request_id}, "the header is the same");
  }));
}

TYPED_TEST(EveryMessage, IsRefusedAtAnyOtherLength) {
  EXPECT_TRUE(holds([] {
    Bytes body = body_of(arbitrary<TypeParam>(), 1);
    for (std::size_t size = 0; size < body.size(); ++size) {
      require(decode<TypeParam>(std::span(body).first(size)).error() == DecodeError::too_short, "too short");
    }
    body.push_back(0);
    require(decode<TypeParam>(body).error() == DecodeError::too_long, "too long");
  }));
}

TYPED_TEST(EveryMessage, IsNotTakenForAnother) {
  Bytes body = body_of(TypeParam{}, 1);
  for (int id = 0; id < 256; ++id) {
    body[0] = static_cast<std::uint8_t>(id);
    const auto read = decode<TypeParam>(body);
    EXPECT_EQ(read.ok(), id == TypeParam::kId);
    EXPECT_TRUE(read.ok() || read.error() == DecodeError::wrong_id);
  }
}

// Together with the round trip: bodies and values correspond one to one, so nothing on the wire is ignored.
TYPED_TEST(EveryMessage, IsWrittenAgainAsTheBytesItWasReadFrom) {
  EXPECT_TRUE(holds([] {
    Bytes body = body_of(arbitrary<TypeParam>(), 1);
    if (body.size() > kHeaderSize) {
      const auto at = any_below(kHeaderSize, body.size());
      body[at] = any<std::uint8_t>();
    }
    const auto read = decode<TypeParam>(body);
    if (read) require(body_of(*read, 1) == body, "the bytes are the same");
  }));
}

TEST(Codec, WritesNumbersLittleEndianAndPacked) {
  const AddSegment segment{.kind = SegmentKind::arc,
                           .tag = 0x0102,
                           .length_nm = -2,
                           .angle = 0x0102030405060708,
                           .speed_umps = 750'000,
                           .yaw_rate_uradps = std::numeric_limits<std::int32_t>::min(),
                           .dwell_ms = 0x0A0B0C0D};
  EXPECT_EQ(body_of(segment, 0x0304),
            (Bytes{0x09, 0x04, 0x03, 0x02, 0x02, 0x01, 0xFE, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF,
                   0xFF, 0xFF, 0x08, 0x07, 0x06, 0x05, 0x04, 0x03, 0x02, 0x01, 0xB0, 0x71,
                   0x0B, 0x00, 0x00, 0x00, 0x00, 0x80, 0x0D, 0x0C, 0x0B, 0x0A}));
}

TEST(Codec, WritesOnlyTheChosenTelemetryGroupsInBitOrder) {
  Telemetry sample{.device_time_us = 1, .fields = Telemetry::kDuty | Telemetry::kCounts};
  sample.counts = {.left = 2, .right = -1};
  sample.duty = {.left = 32767, .right = -32767};
  sample.battery.mv = 12'000;  // not chosen, so not on the wire
  const Bytes body = body_of(sample, 0);
  EXPECT_EQ(body, (Bytes{0xC0, 0, 0, 1, 0, 0,    0,    0,    0,    0,    0,    0x22, 0,   0,
                         0,    2, 0, 0, 0, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0x7F, 0x01, 0x80}));
  EXPECT_EQ(decode<Telemetry>(body)->battery.mv, 0);
}

TEST(Codec, RefusesATelemetryGroupThatItDoesNotKnow) {
  Bytes body = body_of(Telemetry{}, 0);
  for (int group = std::bit_width(Telemetry::kAll); group < 32; ++group) {
    Bytes newer = body;
    newer[static_cast<std::size_t>(11 + group / 8)] = static_cast<std::uint8_t>(1 << (group % 8));
    EXPECT_EQ(decode<Telemetry>(newer).error(), DecodeError::bad_value);
  }
}

TEST(Codec, RefusesEveryNumberThatIsNoEnumerationValue) {
  Bytes body = body_of(Booted{}, 0);
  for (int value = 0; value < 256; ++value) {
    body[kHeaderSize] = static_cast<std::uint8_t>(value);
    const auto read = decode<Booted>(body);
    EXPECT_EQ(read.ok(), value <= static_cast<int>(ResetCause::unknown));
    EXPECT_TRUE(read.ok() || read.error() == DecodeError::bad_value);
  }
}

TEST(Codec, RefusesTextBehindANul) {
  Bytes body = body_of(StageParameter{.id = 1, .value = 0, .text = "ab"}, 1);
  ASSERT_TRUE(decode<StageParameter>(body).ok());
  body.back() = 'x';
  EXPECT_EQ(decode<StageParameter>(body).error(), DecodeError::bad_value);
}

TEST(Codec, SendsTextThatFillsItsField) {
  const StageParameter full{.text = "123456789012345678901234"};
  EXPECT_EQ(decode<StageParameter>(body_of(full, 1))->text.view(), "123456789012345678901234");
}

TEST(Codec, WorksAtCompileTime) {
  constexpr bool kSame = [] {
    std::array<std::uint8_t, kMaxBody> out{};
    const Velocity sent{.v_umps = -1, .omega_uradps = 2};
    const std::size_t size = encode(sent, 9, out);
    return *decode<Velocity>(std::span(out).first(size)) == sent;
  }();
  static_assert(kSame);
}

RC_GTEST_PROP(Codec, ReadsNoiseAsAMessageOrANamedError, (Bytes noise)) {
  const auto try_all = [&]<Message M>() {
    if (!noise.empty() && any<bool>()) noise[0] = M::kId;
    const auto read = decode<M>(noise);
    if (!read) require(!name(read.error()).empty(), "the error has a name");
  };
  Requests::visit(try_all);
  Replies::visit(try_all);
  Events::visit(try_all);
}

}  // namespace

}  // namespace astro::protocol
