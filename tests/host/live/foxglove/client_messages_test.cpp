#include "host/live/foxglove/client_messages.hpp"

#include <gmock/gmock.h>

#include <iostream>
#include <random>

#include "host/base/error.hpp"
#include "tests/support/base/mutations.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::foxglove {
namespace {

using support::Tells;
using testing::ElementsAre;

template <class T>
T read(std::string_view text) {
  return std::get<T>(parse_text(text));
}

Remark complaint_about(std::string_view text) {
  return support::told_by([&] { parse_text(text); });
}

Remark complaint_about(const Bytes& frame) {
  return support::told_by([&] { parse_binary(frame); });
}

/// As the official client writes them.
const std::vector<std::string> kTexts{
    R"({"op":"subscribe","subscriptions":[{"id":0,"channelId":3},{"id":4294967295,"channelId":1}]})",
    R"({"op":"unsubscribe","subscriptionIds":[0,7]})",
    R"({"op":"advertise","channels":[{"id":5,"topic":"/cmd_vel","encoding":"cdr","schemaName":"geometry_msgs/msg/Twist","schema":"...","schemaEncoding":"ros2msg"}]})",
    R"({"op":"unadvertise","channelIds":[5]})",
    R"({"op":"getParameters","parameterNames":["c_R","b"],"id":"q1"})",
    R"({"op":"setParameters","parameters":[{"name":"c_R","value":1.002,"type":"float64"},{"name":"n","value":-7},{"name":"t","value":"x"},{"name":"o","value":true}]})",
    R"({"op":"subscribeParameterUpdates","parameterNames":["b"]})",
    R"({"op":"unsubscribeParameterUpdates","parameterNames":[]})",
    R"({"op":"subscribeConnectionGraph"})",
    R"({"op":"unsubscribeConnectionGraph"})"};

TEST(ClientMessages, EachOperationIsReadWithItsFields) {
  const auto subscribe = read<Subscribe>(kTexts[0]);
  ASSERT_EQ(subscribe.subscriptions.size(), 2U);
  EXPECT_EQ(subscribe.subscriptions[0].id, 0U);
  EXPECT_EQ(subscribe.subscriptions[0].channel, 3U);
  EXPECT_EQ(subscribe.subscriptions[1].id, 4294967295U);
  EXPECT_THAT(read<Unsubscribe>(kTexts[1]).ids, ElementsAre(0, 7));
  const auto advertise = read<Advertise>(kTexts[2]);
  ASSERT_EQ(advertise.channels.size(), 1U);
  EXPECT_EQ(advertise.channels[0].id, 5U);
  EXPECT_EQ(advertise.channels[0].topic, "/cmd_vel");
  EXPECT_EQ(advertise.channels[0].encoding, "cdr");
  EXPECT_EQ(advertise.channels[0].schema_name, "geometry_msgs/msg/Twist");
  EXPECT_THAT(read<Unadvertise>(kTexts[3]).ids, ElementsAre(5));
  EXPECT_THAT(read<GetParameters>(kTexts[4]).names, ElementsAre("c_R", "b"));
  EXPECT_EQ(read<GetParameters>(kTexts[4]).id, "q1");
  EXPECT_THAT(read<WatchParameters>(kTexts[6]).names, ElementsAre("b"));
  EXPECT_TRUE(read<WatchParameters>(kTexts[6]).on);
  EXPECT_FALSE(read<WatchParameters>(kTexts[7]).on);
  EXPECT_TRUE(read<WatchGraph>(kTexts[8]).on);
  EXPECT_FALSE(read<WatchGraph>(kTexts[9]).on);
}

TEST(ClientMessages, ParameterValuesKeepTheirTypes) {
  const auto set = read<SetParameters>(kTexts[5]);
  ASSERT_EQ(set.parameters.size(), 4U);
  EXPECT_EQ(set.id, std::nullopt);
  EXPECT_EQ(set.parameters[0].value.type, 3);
  EXPECT_EQ(set.parameters[0].value.double_value, 1.002);
  EXPECT_EQ(set.parameters[1].value.type, 2);
  EXPECT_EQ(set.parameters[1].value.integer_value, -7);
  EXPECT_EQ(set.parameters[2].value.type, 4);
  EXPECT_EQ(set.parameters[2].value.string_value, "x");
  EXPECT_EQ(set.parameters[3].value.type, 1);
  EXPECT_TRUE(set.parameters[3].value.bool_value);
}

TEST(ClientMessages, AWholeNumberMarkedAsFloat64IsReal) {
  const auto set =
      read<SetParameters>(R"({"op":"setParameters","parameters":[{"name":"b","value":1,"type":"float64"}]})");
  EXPECT_EQ(set.parameters.at(0).value.type, 3);
  EXPECT_EQ(set.parameters.at(0).value.double_value, 1.0);
}

TEST(ClientMessages, WhatIsWrongIsNamed) {
  EXPECT_THAT(complaint_about("{"), Tells(MessageProblem::not_json));
  EXPECT_THAT(complaint_about("[1]"), Tells(MessageProblem::missing, "op"));
  EXPECT_THAT(complaint_about(R"({"op":7})"), Tells(MessageProblem::not_a_text, "op"));
  EXPECT_THAT(complaint_about(R"({"op":"fly"})"), Tells(MessageProblem::unknown_operation, "fly"));
  EXPECT_THAT(complaint_about(R"({"op":"subscribe"})"), Tells(MessageProblem::missing, "subscriptions"));
  EXPECT_THAT(complaint_about(R"({"op":"subscribe","subscriptions":{}})"),
              Tells(MessageProblem::not_a_list, "subscriptions"));
  EXPECT_THAT(complaint_about(R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":1}]})"),
              Tells(MessageProblem::not_32_bits, "id"));
  EXPECT_THAT(complaint_about(R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":4294967296}]})"),
              Tells(MessageProblem::not_32_bits, "channelId"));
  EXPECT_THAT(complaint_about(R"({"op":"unsubscribe","subscriptionIds":[1.5]})"),
              Tells(MessageProblem::not_32_bits, "subscriptionIds"));
  EXPECT_THAT(complaint_about(R"({"op":"setParameters","parameters":[{"name":"b","value":[1]}]})"),
              Tells(MessageProblem::no_parameter_value));
  EXPECT_THAT(
      complaint_about(R"({"op":"setParameters","parameters":[{"name":"b","value":18446744073709551615}]})"),
      Tells(MessageProblem::beyond_64_bits));
}

TEST(ClientMessages, LongNamesDeepValuesAndHugeTextsAreRefused) {
  const std::string name(256, 'n');
  EXPECT_THAT(complaint_about(R"({"op":"getParameters","parameterNames":[")" + name + R"("]})"),
              Tells(MessageProblem::name_too_long, "parameterNames"));
  EXPECT_THAT(complaint_about(std::string(200'000, '[')), Tells(MessageProblem::nested_too_deep));
  std::string many = R"({"op":"getParameters","parameterNames":["a")";
  for (std::size_t i = 0; i < kMostListed; ++i) many += R"(,"a")";
  EXPECT_THAT(complaint_about(many + "]}"), Tells(MessageProblem::too_many_entries, "parameterNames"));
  EXPECT_THAT(complaint_about(std::string(kLongestText + 1, ' ')), Tells(MessageProblem::text_too_long));
}

TEST(ClientMessages, BinaryFramesAreReadAsPublished) {
  const Bytes publish{1, 5, 0, 0, 0, 0, 1, 0, 0, 42};
  const auto message = std::get<Publish>(parse_binary(publish));
  EXPECT_EQ(message.channel, 5U);
  EXPECT_THAT(message.data, ElementsAre(0, 1, 0, 0, 42));
  const Bytes call{2, 7, 0, 0, 0, 9, 0, 0, 0, 3, 0, 0, 0, 'c', 'd', 'r', 0, 1, 0, 0};
  const auto service = std::get<ServiceCall>(parse_binary(call));
  EXPECT_EQ(service.service, 7U);
  EXPECT_EQ(service.call, 9U);
  EXPECT_EQ(service.encoding, "cdr");
  EXPECT_THAT(service.data, ElementsAre(0, 1, 0, 0));
}

TEST(ClientMessages, ShortFramesAndUnknownKindsAreRefused) {
  const Bytes call{2, 7, 0, 0, 0, 9, 0, 0, 0, 3, 0, 0, 0, 'c', 'd', 'r'};
  for (std::size_t size = 0; size < call.size(); ++size)
    EXPECT_THAT(complaint_about(Bytes(call.begin(), call.begin() + static_cast<std::ptrdiff_t>(size))),
                Tells(MessageProblem::frame_too_short))
        << size;
  EXPECT_NO_THROW(parse_binary(call));
  EXPECT_THAT(complaint_about(Bytes{2, 0, 0, 0, 0, 0, 0, 0, 0, 255, 255, 255, 255, 'c'}),
              Tells(MessageProblem::frame_too_short));
  EXPECT_THAT(complaint_about(Bytes{3, 0}), Tells(MessageProblem::unknown_frame, "3"));
}

TEST(ClientMessages, DamagedMessagesAreReadOrRefusedAndNothingElse) {
  constexpr unsigned kSeed = 20261124;
  std::cout << "  seed " << kSeed << '\n';
  support::Mutator mutate(kSeed);
  int refused = 0;
  for (int i = 0; i < 20'000; ++i)
    if (!complaint_about(mutate.text(kTexts[static_cast<std::size_t>(i) % kTexts.size()])).sentence.empty())
      ++refused;
  EXPECT_GT(refused, 10'000);  // most damage hits JSON's grammar
  EXPECT_LT(refused, 20'000);  // some only changes a number or a name
}

}  // namespace
}  // namespace astro::foxglove
