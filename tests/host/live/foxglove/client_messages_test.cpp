#include "host/live/foxglove/client_messages.hpp"

#include <gmock/gmock.h>

#include <iostream>
#include <random>

#include "host/base/error.hpp"
#include "tests/support/base/mutations.hpp"

namespace astro::foxglove {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

template <class T>
T read(std::string_view text) {
  return std::get<T>(parse_text(text));
}

std::string complaint_about(std::string_view text) {
  try {
    parse_text(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

std::string complaint_about(const Bytes& frame) {
  try {
    parse_binary(frame);
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
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
  EXPECT_THAT(complaint_about("{"), HasSubstr("is not JSON"));
  EXPECT_THAT(complaint_about("[1]"), HasSubstr("no 'op'"));
  EXPECT_THAT(complaint_about(R"({"op":7})"), HasSubstr("'op' is not a text"));
  EXPECT_THAT(complaint_about(R"({"op":"fly"})"), HasSubstr("no 'fly'"));
  EXPECT_THAT(complaint_about(R"({"op":"subscribe"})"), HasSubstr("no 'subscriptions'"));
  EXPECT_THAT(complaint_about(R"({"op":"subscribe","subscriptions":{}})"), HasSubstr("not a list"));
  EXPECT_THAT(complaint_about(R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":1}]})"),
              HasSubstr("'id' is not a whole number"));
  EXPECT_THAT(complaint_about(R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":4294967296}]})"),
              HasSubstr("'channelId'"));
  EXPECT_THAT(complaint_about(R"({"op":"unsubscribe","subscriptionIds":[1.5]})"), HasSubstr("32 bits"));
  EXPECT_THAT(complaint_about(R"({"op":"setParameters","parameters":[{"name":"b","value":[1]}]})"),
              HasSubstr("neither a number"));
  EXPECT_THAT(
      complaint_about(R"({"op":"setParameters","parameters":[{"name":"b","value":18446744073709551615}]})"),
      HasSubstr("64 bits"));
}

TEST(ClientMessages, LongNamesDeepValuesAndHugeTextsAreRefused) {
  const std::string name(256, 'n');
  EXPECT_THAT(complaint_about(R"({"op":"getParameters","parameterNames":[")" + name + R"("]})"),
              HasSubstr("longer than 255"));
  EXPECT_THAT(complaint_about(std::string(200'000, '[')), HasSubstr("nested deeper"));
  std::string many = R"({"op":"getParameters","parameterNames":["a")";
  for (std::size_t i = 0; i < kMostListed; ++i) many += R"(,"a")";
  EXPECT_THAT(complaint_about(many + "]}"), HasSubstr("more than 1000 entries"));
  EXPECT_THAT(complaint_about(std::string(kLongestText + 1, ' ')), HasSubstr("longer than"));
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
                HasSubstr("too short"))
        << size;
  EXPECT_EQ(complaint_about(call), "none");
  EXPECT_THAT(complaint_about(Bytes{2, 0, 0, 0, 0, 0, 0, 0, 0, 255, 255, 255, 255, 'c'}),
              HasSubstr("too short"));
  EXPECT_THAT(complaint_about(Bytes{3, 0}), HasSubstr("kind 3"));
}

TEST(ClientMessages, DamagedMessagesAreReadOrRefusedAndNothingElse) {
  constexpr unsigned kSeed = 20261124;
  std::cout << "  seed " << kSeed << '\n';
  support::Mutator mutate(kSeed);
  int refused = 0;
  for (int i = 0; i < 20'000; ++i)
    if (complaint_about(mutate.text(kTexts[static_cast<std::size_t>(i) % kTexts.size()])) != "none")
      ++refused;
  EXPECT_GT(refused, 10'000);  // most damage hits JSON's grammar
  EXPECT_LT(refused, 20'000);  // some only changes a number or a name
}

}  // namespace
}  // namespace astro::foxglove
