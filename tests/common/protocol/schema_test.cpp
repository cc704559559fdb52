#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <set>
#include <string_view>
#include <type_traits>
#include <vector>

#include "common/protocol/codec.hpp"
#include "common/protocol/messages.hpp"
#include "hal/interface/board.hpp"
#include "tests/common/protocol/body_of.hpp"

namespace astro::protocol {
namespace {

using tests::body_of;

template <class F>
void visit_all(F&& f) {
  Requests::visit(f);
  Replies::visit(f);
  Events::visit(f);
}

constexpr std::size_t kMessages = Requests::kSize + Replies::kSize + Events::kSize;

TEST(Schema, HasNoIdAndNoNameTwice) {
  std::set<int> ids;
  std::set<std::string_view> names;
  visit_all([&]<Message M>() {
    ids.insert(M::kId);
    names.insert(M::kName);
  });
  EXPECT_EQ(ids.size(), kMessages);
  EXPECT_EQ(names.size(), kMessages);
}

TEST(Schema, KeepsIdsInTheRangeOfTheirRole) {
  Requests::visit([]<Message M>() {
    EXPECT_TRUE(M::kId >= 0x01 && M::kId <= 0x3F) << M::kName;
    using Reply = typename M::Reply;
    EXPECT_TRUE((std::is_same_v<Reply, Ack>) || Reply::kId == (0x80 | M::kId)) << M::kName;
  });
  Events::visit([]<Message M>() { EXPECT_GE(M::kId, 0xC0) << M::kName; });
}

TEST(Schema, LetsNoBodyExceedTheLargestFrame) {
  visit_all([]<Message M>() { EXPECT_LE(kBodySize<M>, kMaxBody) << M::kName; });
}

TEST(Schema, ExplainsEveryMessageAndNamesEveryFieldOnce) {
  visit_all([]<Message M>() {
    EXPECT_TRUE(M::kDoc.ends_with('.')) << M::kName;
    std::set<std::string_view> names;
    std::size_t count = 0;
    const auto see = [&](const auto& field) {
      names.insert(field.name);
      ++count;
    };
    detail::each<false, M>(see);
    detail::each<true, M>(see);
    EXPECT_EQ(names.size(), count) << M::kName;
  });
}

// A member that is missing from kFields would be lost on the way. The bodies of all structs below hold every
// byte of their members once, so a missing one shows as a size too small.
TEST(Schema, SendsEveryMember) {
  EXPECT_EQ(kBodySize<HelloReply>, 3U + 2 + 3 + 16 + 24 + 24 + 2 + 2);
  EXPECT_EQ(kBodySize<Status>, 3U + 8 + 1 + 4 + 2 + 2 + 4 + 4 + 4 + 4 + 4 + 1 + 2);
  EXPECT_EQ(kBodySize<Velocity>, 3U + 4 + 4);
  EXPECT_EQ(kBodySize<AddSegment>, 3U + 1 + 2 + 8 + 8 + 4 + 4 + 4);
  EXPECT_EQ(kBodySize<WheelVoltage>, 3U + 4 + 4);
  EXPECT_EQ(kBodySize<SegmentStarted>, 3U + 2 + 8);
  EXPECT_EQ(kBodySize<SetPose>, 3U + 8 + 8 + 8);
  EXPECT_EQ(kBodySize<ParameterInfo>, 3U + 2 + 24 + 8 + 1 + 1 + 4 + 4 + 4 + 120);
  EXPECT_EQ(kBodySize<ParameterValue>, 3U + 2 + 4 + 4 + 24 + 24);
  EXPECT_EQ(kBodySize<StageParameter>, 3U + 2 + 4 + 24);
  EXPECT_EQ(kBodySize<SetTelemetry>, 3U + 2 + 4);
  EXPECT_EQ(kBodySize<FaultReport>, 3U + 4 + 1 + 8 + 4);
  EXPECT_EQ(kBodySize<FaultLogEntry>, 3U + 4 + 4 + 8 + 1 + 1 + 4 + 4 + 4 + 2);
  EXPECT_EQ(kBodySize<SegmentDone>, 3U + 2 + 1 + 8);
  EXPECT_EQ(kBodySize<FaultRaised>, 3U + 1 + 8);
  EXPECT_EQ(kBodySize<Telemetry>, 3U + 12 + 28 + 8 + 8 + 8 + 8 + 4 + 4 + 7 + 14 + 49);
  EXPECT_EQ(kBodySize<SlipFound>, 3U + 8 + 2);
}

TEST(Schema, NamesTheTelemetryGroupsByTheBitsOfTheirConstants) {
  EXPECT_EQ(detail::group_mask<Telemetry>(), Telemetry::kAll);
  std::vector<std::uint32_t> bits;
  detail::each<true, Telemetry>([&](const auto& group) { bits.push_back(1U << group.bit); });
  EXPECT_EQ(bits, (std::vector<std::uint32_t>{Telemetry::kPose, Telemetry::kCounts, Telemetry::kTwist,
                                              Telemetry::kWheelSpeed, Telemetry::kSetpoint, Telemetry::kDuty,
                                              Telemetry::kBattery, Telemetry::kState, Telemetry::kPath,
                                              Telemetry::kFused}));
}

// Every version must read these bytes: never change them.
TEST(Schema, KeepsTheFrozenMessagesByteForByte) {
  EXPECT_EQ(body_of(Hello{.protocol_version = 0x1234}, 0xABCD),
            (std::vector<std::uint8_t>{0x01, 0xCD, 0xAB, 0x34, 0x12}));
  EXPECT_EQ(body_of(ErrorReply{.code = ErrorCode::wrong_version, .detail = 1}, 2),
            (std::vector<std::uint8_t>{0x7F, 0x02, 0x00, 0x02, 0x01, 0x00}));
  HelloReply reply{.protocol_version = 0x0102, .fw_major = 3, .fw_minor = 4, .fw_patch = 5};
  reply.unique_id = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  reply.board = "sim";
  reply.robot_name = "ASTRO";
  reply.parameter_count = 0x0607;
  reply.tick_hz = 1000;
  std::vector<std::uint8_t> expected{0x81, 1, 0, 2, 1, 3, 4,  5,  0,  1,  2,  3,
                                     4,    5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  const auto append = [&](std::string_view text, std::size_t padding) {
    expected.insert(expected.end(), text.begin(), text.end());
    expected.insert(expected.end(), padding, 0);
  };
  append("sim", 21);
  append("ASTRO", 19);
  expected.insert(expected.end(), {0x07, 0x06, 0xE8, 0x03});
  EXPECT_EQ(body_of(reply, 1), expected);
}

TEST(Schema, KeepsTheNumbersOfEnumerationValues) {
  EXPECT_EQ(static_cast<int>(Mode::fault), 5);
  EXPECT_EQ(static_cast<int>(Mode::paused), 8);
  EXPECT_EQ(static_cast<int>(SegmentKind::arc), 2);
  EXPECT_EQ(static_cast<int>(SegmentOutcome::aborted), 1);
  EXPECT_EQ(static_cast<int>(ParameterKind::text), 4);
  EXPECT_EQ(static_cast<int>(ErrorCode::queue_full), 5);
  EXPECT_EQ(static_cast<int>(ErrorCode::busy), 12);
  EXPECT_EQ(static_cast<int>(Fault::emergency_stop), 12);
  EXPECT_EQ(static_cast<int>(Fault::watchdog), 14);
  EXPECT_EQ(static_cast<int>(Fault::stop_timeout), 15);
}

TEST(Schema, NamesEveryEnumerationValueAndNoOther) {
  EXPECT_EQ(name(Mode::stopping), "stopping");
  EXPECT_EQ(name(ErrorCode::busy), "busy");
  EXPECT_EQ(name(Fault::tick_overrun), "tick_overrun");
  EXPECT_EQ(name(Mode{9}), "?");
  EXPECT_EQ(name(Fault{17}), "?");
  EXPECT_EQ(meaning(ErrorCode::moving), "the robot must be at rest for this");
  EXPECT_EQ(meaning(ErrorCode{14}), "an error of another protocol version");
}

TEST(Schema, CountsResetCausesAsTheBoardDoes) {
  EXPECT_EQ(static_cast<int>(ResetCause::power_on), static_cast<int>(hal::ResetCause::power_on));
  EXPECT_EQ(static_cast<int>(ResetCause::software), static_cast<int>(hal::ResetCause::software));
  EXPECT_EQ(static_cast<int>(ResetCause::watchdog), static_cast<int>(hal::ResetCause::watchdog));
  EXPECT_EQ(static_cast<int>(ResetCause::fault), static_cast<int>(hal::ResetCause::fault));
  EXPECT_EQ(static_cast<int>(ResetCause::pin), static_cast<int>(hal::ResetCause::pin));
  EXPECT_EQ(static_cast<int>(ResetCause::unknown), static_cast<int>(hal::ResetCause::unknown));
}

TEST(Text, HoldsAsManyBytesAsItSaysAndKeepsTheFirstOfMore) {
  EXPECT_EQ(Text<4>("abcd").view(), "abcd");
  EXPECT_EQ(Text<4>(std::string_view("abcde")).view(), "abcd");
  EXPECT_TRUE(Text<4>::fits("abcd"));
  EXPECT_FALSE(Text<4>::fits("abcde"));
  EXPECT_TRUE(Text<4>().empty());
}

TEST(Text, EndsAtANulSoThatEqualTextsHaveEqualBytes) {
  EXPECT_EQ(Text<4>(std::string_view("a\0b", 3)), Text<4>("a"));
  EXPECT_EQ(Text<4>(std::string_view("a\0b", 3)).characters(), Text<4>("a").characters());
  EXPECT_TRUE(Text<4>("a") == std::string_view("a"));
}

}  // namespace
}  // namespace astro::protocol
