#include "host/live/foxglove/hub.hpp"

#include <gmock/gmock.h>

#include <iostream>

#include "host/formats/messages/geometry.hpp"
#include "host/formats/messages/std.hpp"
#include "tests/support/base/json.hpp"
#include "tests/support/base/mutations.hpp"

namespace astro::foxglove {
namespace {

using nlohmann::json;
using support::parse_json;
using testing::ElementsAre;
using testing::HasSubstr;

SharedSample sample(std::uint8_t what, std::size_t size = 1) {
  return std::make_shared<const Sample>(Sample{what, Bytes(size, what)});
}

/// A hub with a fast topic (channel 1), a latched one (2), a topic that it takes, and a service.
class HubOfARobot : public testing::Test {
 protected:
  HubOfARobot() {
    hub_.add(Channel{1, {"/odom", live::message_type<ros2::msg::Pose>()}, {}, odom_});
    live::TopicDescription latched{"/model", live::message_type<ros2::msg::String>()};
    latched.latched = true;
    latched.depth = 2;
    hub_.add(Channel{2, latched, {}, model_});
    hub_.add(Inlet{1, {"/cmd_vel", live::message_type<ros2::msg::Twist>()}});
    hub_.add(Service{1,
                     {"/stop", ros2::msg::Trigger::kType, live::message_type<ros2::msg::Trigger::Request>(),
                      live::message_type<ros2::msg::Trigger::Response>()}});
    hub_.has_parameters();
  }

  Session& greeted() {
    Session& session = hub_.join();
    while (session.queue().pop()) continue;
    return session;
  }
  static void say(Session& session, std::string_view text) { session.receive(true, as_bytes(text)); }

  static std::vector<json> texts(Session& session) {
    std::vector<json> all;
    while (const auto frame = session.queue().pop())
      if (frame->is_text) all.push_back(parse_json(frame->head));
    return all;
  }
  /// Subscription and first byte of each data message.
  static std::vector<std::pair<std::uint32_t, int>> data(Session& session) {
    std::vector<std::pair<std::uint32_t, int>> all;
    while (const auto frame = session.queue().pop())
      if (frame->sample)
        all.emplace_back(load<std::uint32_t>(as_bytes(frame->head), 1), frame->sample->payload.at(0));
    return all;
  }
  static std::string first_status(Session& session) {
    for (const json& each : texts(session))
      if (each["op"] == "status" || each["op"] == "serviceCallFailure") return each["message"];
    return "none";
  }

  std::shared_ptr<std::atomic<int>> odom_ = std::make_shared<std::atomic<int>>(0);
  std::shared_ptr<std::atomic<int>> model_ = std::make_shared<std::atomic<int>>(0);
  std::vector<Request> asked_;
  Hub hub_{"robot", "s1", true, [this](Request request) { asked_.push_back(std::move(request)); }};
};

constexpr std::string_view kSubscribeBoth =
    R"({"op":"subscribe","subscriptions":[{"id":10,"channelId":1},{"id":20,"channelId":2}]})";

TEST_F(HubOfARobot, GreetsWithInformationThenChannelsThenServices) {
  const auto said = texts(hub_.join());
  ASSERT_EQ(said.size(), 3U);
  EXPECT_EQ(said[0]["op"], "serverInfo");
  EXPECT_EQ(said[1]["op"], "advertise");
  EXPECT_EQ(said[1]["channels"].size(), 2U);
  EXPECT_EQ(said[2]["op"], "advertiseServices");
}

TEST_F(HubOfARobot, SendsAMessageToThoseWhoSubscribeUnderTheirOwnNumbers) {
  Session &one = greeted(), &other = greeted(), &none = greeted();
  say(one, kSubscribeBoth);
  say(other, R"({"op":"subscribe","subscriptions":[{"id":0,"channelId":1}]})");
  EXPECT_EQ(*odom_, 2);
  hub_.publish(1, sample(7));
  EXPECT_THAT(data(one), ElementsAre(std::pair(10U, 7)));
  EXPECT_THAT(data(other), ElementsAre(std::pair(0U, 7)));
  EXPECT_TRUE(data(none).empty());
}

TEST_F(HubOfARobot, RepeatsTheLastLatchedMessagesForEachNewSubscription) {
  for (const std::uint8_t what : Bytes{1, 2, 3}) hub_.publish(2, sample(what));
  Session& late = greeted();
  say(late, kSubscribeBoth);
  EXPECT_THAT(data(late), ElementsAre(std::pair(20U, 2), std::pair(20U, 3)));
  say(late, R"({"op":"unsubscribe","subscriptionIds":[20]})");
  say(late, R"({"op":"subscribe","subscriptions":[{"id":21,"channelId":2}]})");
  EXPECT_THAT(data(late), ElementsAre(std::pair(21U, 2), std::pair(21U, 3)));
}

TEST_F(HubOfARobot, ForgetsWhatWaitsForASubscriptionThatEnds) {
  Session& session = greeted();
  say(session, kSubscribeBoth);
  hub_.publish(1, sample(7));
  hub_.publish(2, sample(8));
  say(session, R"({"op":"unsubscribe","subscriptionIds":[10,20]})");
  EXPECT_EQ(*odom_, 0);
  hub_.publish(1, sample(9));
  EXPECT_TRUE(data(session).empty());
}

TEST_F(HubOfARobot, CountsNoSubscriberThatHasLeft) {
  Session& session = greeted();
  say(session, kSubscribeBoth);
  ASSERT_EQ(*odom_, 1);
  hub_.leave(session.id());
  EXPECT_EQ(*odom_, 0);
  EXPECT_EQ(*model_, 0);
}

TEST_F(HubOfARobot, DropsTheOldestDataOfASlowClientAndSaysHowMany) {
  Session &slow = greeted(), &fast = greeted();
  say(slow, kSubscribeBoth);
  say(fast, kSubscribeBoth);
  constexpr int kSent = 20;  // of 400 kB each: ten fit into 4 MiB
  hub_.publish(2, sample(200, 100'000));
  for (int i = 0; i < kSent; ++i) {
    hub_.publish(1, sample(static_cast<std::uint8_t>(i), 400'000));
    EXPECT_EQ(data(fast).back().second, i);
  }
  hub_.report();
  EXPECT_EQ(slow.queue().dropped(), 10U);
  EXPECT_EQ(fast.queue().dropped(), 0U);
  std::vector<int> got;
  std::string warning;
  while (const auto frame = slow.queue().pop()) {
    if (frame->is_text) warning = parse_json(frame->head)["message"];
    if (frame->sample) got.push_back(frame->sample->payload[0]);
  }
  EXPECT_THAT(warning, HasSubstr("10 messages were dropped"));
  EXPECT_THAT(got, ElementsAre(200, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19))
      << "latched data first, never dropped";
  hub_.report();
  EXPECT_TRUE(texts(slow).empty()) << "a drop is told once";
}

TEST_F(HubOfARobot, GivesUpAClientThatDoesNotReadItsControlMessages) {
  Session& session = greeted();
  say(session, kSubscribeBoth);
  for (int i = 0; i < 41; ++i) hub_.publish(2, sample(1, 100'000));
  EXPECT_FALSE(session.queue().overflowed()) << "4.1 MB";
  for (int i = 0; i < 2; ++i) hub_.publish(2, sample(1, 100'000));
  EXPECT_TRUE(session.queue().overflowed());
}

TEST_F(HubOfARobot, ComplainsOfWhatCannotBeSubscribed) {
  Session& session = greeted();
  say(session, R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":3}]})");
  EXPECT_EQ(first_status(session), "there is no channel 3");
  say(session, R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":0}]})");
  EXPECT_EQ(first_status(session), "there is no channel 0");
  say(session, kSubscribeBoth);
  say(session, R"({"op":"subscribe","subscriptions":[{"id":10,"channelId":1}]})");
  EXPECT_EQ(first_status(session), "there is a subscription 10 already");
  say(session, R"({"op":"subscribe","subscriptions":[{"id":11,"channelId":1}]})");
  EXPECT_EQ(first_status(session), "channel 1 is subscribed already");
  say(session, R"({"op":"unsubscribe","subscriptionIds":[99]})");
  EXPECT_EQ(first_status(session), "there is no subscription 99");
  EXPECT_EQ(*odom_, 1);
}

Bytes publication(std::uint8_t channel) { return {1, channel, 0, 0, 0, 0, 1, 0, 0}; }

TEST_F(HubOfARobot, PassesOnWhatAClientPublishesOnATopicThatTheRobotTakes) {
  Session& session = greeted();
  say(session, R"({"op":"advertise","channels":[
    {"id":5,"topic":"/cmd_vel","encoding":"cdr","schemaName":"geometry_msgs/msg/Twist"},
    {"id":6,"topic":"/cmd_vel","encoding":"cdr","schemaName":"geometry_msgs/Twist"}]})");
  for (const std::uint8_t channel : Bytes{5, 6}) session.receive(false, publication(channel));
  EXPECT_TRUE(texts(session).empty());
  ASSERT_EQ(asked_.size(), 2U);
  EXPECT_EQ(std::get<MessageArrived>(asked_[0]).inlet, 1U);
  EXPECT_THAT(std::get<MessageArrived>(asked_[0]).message, ElementsAre(0, 1, 0, 0));
  say(session, R"({"op":"unadvertise","channelIds":[5]})");
  session.receive(false, publication(5));
  EXPECT_EQ(first_status(session), "no channel 5 is advertised");
  EXPECT_EQ(asked_.size(), 2U);
}

TEST_F(HubOfARobot, TakesNoOtherTopicTypeOrEncoding) {
  Session& session = greeted();
  for (const char* what : {R"("/odom","encoding":"cdr","schemaName":"geometry_msgs/msg/Twist")",
                           R"("/cmd_vel","encoding":"cdr","schemaName":"geometry_msgs/msg/TwistStamped")",
                           R"("/cmd_vel","encoding":"cdr","schemaName":"/Twist")",
                           R"("/cmd_vel","encoding":"json","schemaName":"geometry_msgs/msg/Twist")"}) {
    say(session, R"({"op":"advertise","channels":[{"id":5,"topic":)" + std::string(what) + "}]}");
    EXPECT_NE(first_status(session), "none") << what;
  }
  session.receive(false, publication(5));
  EXPECT_TRUE(asked_.empty());
}

Bytes call(std::uint8_t service, std::uint8_t number, std::string_view encoding = "cdr") {
  Bytes bytes{2, service, 0, 0, 0, number, 0, 0, 0, static_cast<std::uint8_t>(encoding.size()), 0, 0, 0};
  append(bytes, as_bytes(encoding));
  append(bytes, Bytes{0, 1, 0, 0, 0});
  return bytes;
}

TEST_F(HubOfARobot, AnswersACallToTheClientThatMadeIt) {
  Session &one = greeted(), &other = greeted();
  one.receive(false, call(1, 3));
  ASSERT_EQ(asked_.size(), 1U);
  const auto& arrived = std::get<CallArrived>(asked_[0]);
  EXPECT_EQ(arrived.client, one.id());
  EXPECT_EQ(arrived.call, 3U);
  hub_.answer_binary(arrived.client, "answer");
  const auto frame = one.queue().pop();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->head, "answer");
  EXPECT_FALSE(frame->is_text);
  EXPECT_TRUE(other.queue().empty());
}

TEST_F(HubOfARobot, RefusesCallsThatMakeNoSense) {
  Session& session = greeted();
  session.receive(false, call(2, 3));
  EXPECT_EQ(first_status(session), "there is no service 2");
  session.receive(false, call(1, 3, "json"));
  EXPECT_THAT(first_status(session), HasSubstr("not as 'json'"));
  Bytes longest = call(1, 3);
  longest.resize(longest.size() + Session::kLongestQuestion - 5);  // 5 bytes are there
  Bytes too_long = longest;
  too_long.push_back(0);
  session.receive(false, too_long);
  EXPECT_THAT(first_status(session), HasSubstr("at most 16384 bytes, this one 16385"));
  EXPECT_TRUE(asked_.empty());
  session.receive(false, longest);
  EXPECT_EQ(asked_.size(), 1U);
}

TEST_F(HubOfARobot, BearsNoMoreQuestionsOfAClientThanTheRobotAnswers) {
  Session& session = greeted();
  for (int i = 0; i <= Session::kMostQuestions; ++i) session.receive(false, call(1, 1));
  EXPECT_EQ(asked_.size(), static_cast<std::size_t>(Session::kMostQuestions));
  EXPECT_THAT(first_status(session), HasSubstr("not answered"));
  say(session, R"({"op":"getParameters","parameterNames":[]})");
  EXPECT_THAT(first_status(session), HasSubstr("not answered"));
  hub_.answer_text(session.id(), "{}");
  say(session, R"({"op":"getParameters","parameterNames":[]})");
  EXPECT_EQ(asked_.size(), Session::kMostQuestions + 1U);
}

TEST_F(HubOfARobot, SendsParameterChangesToThoseWhoWatchThem) {
  Session &all = greeted(), &one = greeted(), &none = greeted();
  EXPECT_FALSE(hub_.parameters_are_watched());
  say(all, R"({"op":"subscribeParameterUpdates","parameterNames":[]})");
  say(one, R"({"op":"subscribeParameterUpdates","parameterNames":["b","k"]})");
  say(one, R"({"op":"unsubscribeParameterUpdates","parameterNames":["k"]})");
  EXPECT_TRUE(hub_.parameters_are_watched());
  const std::vector<ros2::msg::Parameter> changed{{"b", {}}, {"k", {}}};
  hub_.parameters_changed(changed);
  EXPECT_EQ(texts(all).at(0)["parameters"].size(), 2U);
  const auto told = texts(one);
  ASSERT_EQ(told.at(0)["parameters"].size(), 1U);
  EXPECT_EQ(told[0]["parameters"][0]["name"], "b");
  EXPECT_TRUE(none.queue().empty());
}

TEST_F(HubOfARobot, ShowsTheGraphToThoseWhoWatchItAndThenItsChanges) {
  Session &watcher = greeted(), &other = greeted();
  say(watcher, R"({"op":"subscribeConnectionGraph"})");
  hub_.report();
  const auto first = texts(watcher);
  ASSERT_EQ(first.size(), 1U);
  EXPECT_EQ(first[0]["publishedTopics"].size(), 2U);
  EXPECT_EQ(first[0]["subscribedTopics"][0]["name"], "/cmd_vel");
  EXPECT_EQ(first[0]["advertisedServices"][0]["providerIds"], json({"robot"}));
  hub_.report();
  EXPECT_TRUE(texts(watcher).empty()) << "nothing has changed";
  say(other, kSubscribeBoth);
  hub_.report();
  EXPECT_EQ(texts(watcher).at(0)["subscribedTopics"].size(), 2U);
  EXPECT_TRUE(texts(other).empty());
}

TEST_F(HubOfARobot, BearsWhateverAClientSends) {
  constexpr unsigned kSeed = 1124;
  std::cout << "  seed " << kSeed << '\n';
  support::Mutator mutate(kSeed);
  const std::string subscribe(kSubscribeBoth);
  for (int i = 0; i < 5'000; ++i) {
    Session& session = greeted();
    say(session, mutate.text(subscribe));
    say(session, mutate.text(R"({"op":"unsubscribe","subscriptionIds":[10,20]})"));
    session.receive(false, mutate.bytes(call(1, 1)));
    session.receive(false, mutate.bytes(publication(5)));
    hub_.publish(1, sample(1));
    hub_.publish(2, sample(1));
    hub_.leave(session.id());
    ASSERT_EQ(*odom_ + *model_, 0) << i;
  }
}

}  // namespace
}  // namespace astro::foxglove
