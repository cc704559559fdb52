#include "host/live/foxglove/foxglove_server.hpp"

#include <gmock/gmock.h>

#include <map>

#include "host/base/error.hpp"
#include "host/formats/cdr/codec.hpp"
#include "host/formats/messages/geometry.hpp"
#include "host/formats/messages/std.hpp"
#include "host/live/foxglove/origin.hpp"
#include "tests/host/live/foxglove/viewer.hpp"
#include "tests/support/base/json.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::foxglove {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using std::chrono::steady_clock;
using support::parse_json;
using support::Tells;
using support::Viewer;
using support::ViewerRequest;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr auto kLong = std::chrono::seconds(20);  // only a failure waits so long

/// One real parameter between 0 and 2, and a text.
class SmallTable : public live::ParameterTable {
 public:
  std::vector<ros2::msg::ParameterDescriptor> descriptors() override {
    return {{"b", static_cast<std::uint8_t>(live::ParameterType::real), "", "", false, false, {}, {}},
            {"name", static_cast<std::uint8_t>(live::ParameterType::text), "", "", true, false, {}, {}}};
  }
  std::optional<ros2::msg::ParameterValue> value(std::string_view name) override {
    ros2::msg::ParameterValue value;
    if (name == "b") {
      value.type = static_cast<std::uint8_t>(live::ParameterType::real);
      value.double_value = b;
    } else if (name == "name") {
      value.type = static_cast<std::uint8_t>(live::ParameterType::text);
      value.string_value = "ASTRO";
    } else {
      return std::nullopt;
    }
    return value;
  }
  ros2::msg::SetParametersResult set(std::span<const ros2::msg::Parameter> parameters) override {
    for (const ros2::msg::Parameter& each : parameters) {
      const double wanted = static_cast<live::ParameterType>(each.value.type) == live::ParameterType::integer
                                ? static_cast<double>(each.value.integer_value)
                                : each.value.double_value;
      if (wanted > 2) return {false, each.name + " is above 2"};
      b = wanted;
    }
    return {true, ""};
  }

  double b = 0.2;
};

/// A server with topics, services and parameters, and its thread, which is the test's own.
class FoxgloveServerOnLoopback : public testing::Test {
 protected:
  FoxgloveServer& start(bool allow_commands = true) {
    Settings settings;
    settings.name = "robot";
    settings.address.port = 0;
    settings.allow_commands = allow_commands;
    settings.always_served = {"/emergency_stop"};
    settings.origins = {"https://viewer.example"};
    settings.notice = [this](const Remark& remark) { notices_.push_back(remark); };
    server_ = std::make_unique<FoxgloveServer>(std::move(settings));
    fast_ = server_->advertise({"/fast", live::message_type<ros2::msg::String>()});
    live::TopicDescription latched{"/model", live::message_type<ros2::msg::String>()};
    latched.latched = true;
    latched.depth = 1;
    model_ = server_->advertise(latched);
    server_->subscribe({"/cmd_vel", live::message_type<ros2::msg::Twist>()},
                       [this](ByteView bytes) { commands_.emplace_back(bytes.begin(), bytes.end()); });
    for (const char* name : {"/arm", "/emergency_stop"})
      server_->serve(
          {name, ros2::msg::Trigger::kType, live::message_type<ros2::msg::Trigger::Request>(),
           live::message_type<ros2::msg::Trigger::Response>(), name == std::string_view("/emergency_stop")},
          [name](ByteView request) -> std::optional<Bytes> {
            if (!ros2::decode<ros2::msg::Trigger::Request>(request)) return std::nullopt;
            return ros2::encode(ros2::msg::Trigger::Response{true, name});
          });
    server_->serve_parameters(table_);
    server_->poll();
    return *server_;
  }

  /// The viewer asks to watch, and the server has heard it: what a viewer sends is answered in order, what several send is not.
  void watches(Viewer& viewer, const char* subscription) {
    viewer.send(subscription);
    viewer.send(R"({"op":"getParameters","parameterNames":["b"],"id":"x"})");
    EXPECT_FALSE(hear(viewer, "parameterValues").is_null());
  }

  template <class Condition>
  bool eventually(Condition condition) {
    const auto end = steady_clock::now() + kLong;
    while (!condition()) {
      if (steady_clock::now() > end) return false;
      server_->poll();
    }
    return true;
  }

  /// The next text with this "op"; null if none comes.
  json hear(Viewer& viewer, const std::string& op) {
    json found;
    eventually([&] {
      const auto message = viewer.receive(milliseconds(5));
      if (!message || !message->is_text) return false;
      json text = parse_json(std::string(as_text(message->bytes)));
      if (text["op"] != op) return false;
      found = std::move(text);
      return true;
    });
    return found;
  }
  /// The next binary frame; empty if none comes.
  Bytes hear_binary(Viewer& viewer) {
    Bytes found;
    eventually([&] {
      const auto message = viewer.receive(milliseconds(5));
      if (message && !message->is_text) found = message->bytes;
      return !found.empty();
    });
    return found;
  }

  /// The subprotocol that was agreed on, or the HTTP status of the refusal.
  std::string status_of(const ViewerRequest& request) {
    const support::HttpAnswer answer = support::ask(server_->port(), request);
    return answer.status == 101 ? answer.subprotocol : std::to_string(answer.status);
  }

  SmallTable table_;
  std::vector<Remark> notices_;
  std::vector<Bytes> commands_;
  std::unique_ptr<FoxgloveServer> server_;
  std::unique_ptr<live::Publisher> fast_, model_;
};

Bytes text_message(const std::string& text) { return ros2::encode(ros2::msg::String{text}); }

/// A call of the only service that viewers have without commands, and its answer.
Bytes stop_call() {
  Bytes call{2, 1, 0, 0, 0, 9, 0, 0, 0, 3, 0, 0, 0, 'c', 'd', 'r'};
  append(call, ros2::encode(ros2::msg::Trigger::Request{}));
  return call;
}
Bytes stopped() {
  Bytes answer{3, 1, 0, 0, 0, 9, 0, 0, 0, 3, 0, 0, 0, 'c', 'd', 'r'};
  append(answer, ros2::encode(ros2::msg::Trigger::Response{true, "/emergency_stop"}));
  return answer;
}

TEST_F(FoxgloveServerOnLoopback, AgreesOnEitherSubprotocolAndRefusesOthers) {
  start();
  EXPECT_EQ(status_of({"", "foxglove.websocket.v1"}), "foxglove.websocket.v1");
  EXPECT_EQ(status_of({"", "foxglove.sdk.v1"}), "foxglove.sdk.v1");
  EXPECT_EQ(status_of({"", "foxglove.websocket.v1, foxglove.sdk.v1"}), "foxglove.sdk.v1");
  EXPECT_EQ(status_of({"", "mqtt"}), "400");
  EXPECT_EQ(status_of({"", ""}), "400");
}

TEST_F(FoxgloveServerOnLoopback, TellsABrowserThatItIsNoWebPage) {
  start();
  ViewerRequest page;
  page.upgrade = false;
  EXPECT_EQ(status_of(page), "426");
}

TEST_F(FoxgloveServerOnLoopback, EndsConnectionsThatAskForNothingSensible) {
  start();
  EXPECT_EQ(support::answer_to(server_->port(), "\x16\x03\x01 this is not HTTP\r\n\r\n"), "");
  EXPECT_EQ(support::answer_to(server_->port(), "GET / HTTP/1.1\r\nX: " + std::string(10'000, 'x')), "");
  const auto begin = steady_clock::now();
  EXPECT_EQ(support::answer_to(server_->port(), "GET / HT"), "") << "and then nothing more";
  EXPECT_LT(steady_clock::now() - begin, kLong);
}

TEST_F(FoxgloveServerOnLoopback, RefusesPagesOfOtherOriginsAndSaysWhichOnes) {
  start();
  EXPECT_EQ(status_of({"https://app.foxglove.dev"}), "foxglove.sdk.v1");
  EXPECT_EQ(status_of({"https://viewer.example"}), "foxglove.sdk.v1");
  EXPECT_EQ(status_of({"https://evil.example"}), "403");
  EXPECT_EQ(status_of({"null"}), "403");
  const auto refused = testing::Contains(Tells(OriginProblem::refused, "https://evil.example"));
  EXPECT_TRUE(eventually([&] { return testing::Value(notices_, refused); }));
}

TEST_F(FoxgloveServerOnLoopback, HoweverManyIdleViewersThereAreAnotherOneStopsTheRobot) {
  for (const std::size_t idle : {16U, 64U, 100U}) {
    start(false);
    std::vector<Viewer> viewers;
    for (std::size_t i = 0; i < idle; ++i) viewers.emplace_back(server_->port());
    Viewer late(server_->port());
    late.send(stop_call());
    EXPECT_EQ(hear_binary(late), stopped()) << idle;
  }
}

TEST_F(FoxgloveServerOnLoopback, HoweverManyConnectionsSayNothingAnotherOneStopsTheRobot) {
  start(false);
  std::vector<std::unique_ptr<support::SilentConnection>> silent;
  for (int i = 0; i < 100; ++i)
    silent.push_back(std::make_unique<support::SilentConnection>(server_->port()));
  Viewer late(server_->port());
  late.send(stop_call());
  EXPECT_EQ(hear_binary(late), stopped());
}

TEST_F(FoxgloveServerOnLoopback, TheIdlestViewerGoesAndIsToldWhy) {
  start();
  std::vector<Viewer> viewers;
  for (int i = 0; i < 64; ++i) viewers.emplace_back(server_->port());
  viewers[0].send(R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":1}]})");
  viewers[1].send(R"({"op":"getParameters","parameterNames":["b"],"id":"x"})");
  EXPECT_FALSE(hear(viewers[1], "parameterValues").is_null());
  EXPECT_TRUE(eventually([&] { return fast_->has_subscribers(); }));
  Viewer late(server_->port());
  EXPECT_EQ(hear(late, "serverInfo")["name"], "robot");
  EXPECT_TRUE(eventually([&] { return viewers[2].receive(milliseconds(5)), viewers[2].ended(); }));
  EXPECT_THAT(viewers[2].why_it_ended(), HasSubstr("watched nothing"));
  for (const int stays : {0, 1, 3}) {
    viewers[stays].receive(milliseconds(20));
    EXPECT_FALSE(viewers[stays].ended()) << stays;
  }
}

TEST_F(FoxgloveServerOnLoopback, SixteenWatchAndAnotherOneMayStopTheRobotAndWatchesOnceOneHasGone) {
  start(false);
  const char* const watch =
      R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":1},{"id":2,"channelId":2}]})";
  std::vector<Viewer> viewers;
  for (int i = 0; i < 16; ++i) {
    viewers.emplace_back(server_->port());
    watches(viewers.back(), watch);
  }
  Viewer late(server_->port());
  late.send(watch);
  EXPECT_THAT(hear(late, "status")["message"], HasSubstr("16 viewers watch already"));
  late.send(stop_call());
  EXPECT_EQ(hear_binary(late), stopped());
  viewers.pop_back();
  EXPECT_TRUE(eventually([&] {
    late.send(watch);
    fast_->publish(text_message("now"), 1);
    const auto message = late.receive(milliseconds(20));
    return message && !message->is_text;
  }));
}

TEST_F(FoxgloveServerOnLoopback, AWatcherThatReadsNothingGivesItsPlaceToOneThatWantsToWatch) {
  start();
  const char* const watch = R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":1}]})";
  std::vector<Viewer> viewers;
  ViewerRequest stuck;
  stuck.receive_buffer = 4096;
  for (int i = 0; i < 16; ++i) {
    viewers.emplace_back(server_->port(), i == 5 ? stuck : ViewerRequest{});
    watches(viewers.back(), watch);
  }
  Viewer late(server_->port());
  const std::string piece(100'000, 'x');
  EXPECT_TRUE(eventually([&] {
    fast_->publish(text_message(piece), 1);
    for (int i = 0; i < 16; ++i)
      if (i != 5) viewers[i].receive(milliseconds(1));
    late.send(watch);
    const auto message = late.receive(milliseconds(1));
    return message && !message->is_text;
  }));
  EXPECT_THAT(notices_, testing::Contains(Tells(ViewerProblem::stuck)));
}

TEST_F(FoxgloveServerOnLoopback, ALateViewerGetsTheLatchedMessageAndThenWhatIsPublished) {
  start();
  EXPECT_FALSE(fast_->has_subscribers());
  EXPECT_TRUE(model_->has_subscribers()) << "somebody may come later";
  fast_->publish(text_message("before anybody came"), 1);
  model_->publish(text_message("old model"), 1);
  model_->publish(text_message("model"), 2);
  Viewer viewer(server_->port());
  const json channels = hear(viewer, "advertise")["channels"];
  ASSERT_EQ(channels.size(), 2U);
  EXPECT_EQ(channels[0]["schema"], "string data\n");
  viewer.send(R"({"op":"subscribe","subscriptions":[{"id":7,"channelId":1},{"id":8,"channelId":2}]})");
  Bytes model{1, 8, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0};
  append(model, text_message("model"));
  EXPECT_EQ(hear_binary(viewer), model);
  EXPECT_TRUE(eventually([&] { return fast_->has_subscribers(); }));
  fast_->publish(text_message("now"), 0x0102030405060708);
  Bytes now{1, 7, 0, 0, 0, 8, 7, 6, 5, 4, 3, 2, 1};
  append(now, text_message("now"));
  EXPECT_EQ(hear_binary(viewer), now);
}

TEST_F(FoxgloveServerOnLoopback, CountsTheSubscribersOfThoseWhoHaveLeftNoMore) {
  start();
  {
    Viewer viewer(server_->port());
    viewer.send(R"({"op":"subscribe","subscriptions":[{"id":7,"channelId":1}]})");
    ASSERT_TRUE(eventually([&] { return fast_->has_subscribers(); }));
  }
  EXPECT_TRUE(eventually([&] { return !fast_->has_subscribers(); }));
}

TEST_F(FoxgloveServerOnLoopback, CommandsReachTheRobotIfTheyAreAllowed) {
  start();
  Viewer viewer(server_->port());
  EXPECT_THAT(hear(viewer, "serverInfo")["capabilities"], testing::Contains("clientPublish"));
  viewer.send(
      R"({"op":"advertise","channels":[{"id":1,"topic":"/cmd_vel","encoding":"cdr","schemaName":"geometry_msgs/msg/Twist"}]})");
  Bytes frame{1, 1, 0, 0, 0};
  append(frame, ros2::encode(ros2::msg::Twist{{0.5, 0, 0}, {0, 0, 1}}));
  viewer.send(frame);
  ASSERT_TRUE(eventually([&] { return !commands_.empty(); }));
  EXPECT_EQ(ros2::decode<ros2::msg::Twist>(commands_.at(0)), (ros2::msg::Twist{{0.5, 0, 0}, {0, 0, 1}}));
}

TEST_F(FoxgloveServerOnLoopback, AFloodOfMessagesWhoseAnswersNobodyReadsEndsItsOwnConnectionAlone) {
  start();
  Viewer other(server_->port());
  for (int i = 0; i < 3; ++i) support::flood(server_->port(), "{}", 400'000);
  EXPECT_EQ(hear(other, "serverInfo")["name"], "robot");
}

/// A table that takes a millisecond for each value.
class SlowTable : public SmallTable {
 public:
  std::optional<ros2::msg::ParameterValue> value(std::string_view name) override {
    const auto until = steady_clock::now() + milliseconds(1);
    while (steady_clock::now() < until) continue;
    ++asked;
    return SmallTable::value(name);
  }
  int asked = 0;
};

TEST_F(FoxgloveServerOnLoopback, ManyQuestionsKeepTheRobotNoLongerThanAShareAndNoMessageWaitsForThem) {
  start();
  SlowTable slow;
  server_->serve_parameters(slow);
  Viewer viewer(server_->port());
  viewer.send(
      R"({"op":"advertise","channels":[{"id":1,"topic":"/cmd_vel","encoding":"cdr","schemaName":"geometry_msgs/msg/Twist"}]})");
  constexpr int kQuestions = 60;
  for (int i = 0; i < kQuestions; ++i)
    viewer.send(R"({"op":"getParameters","parameterNames":["b"],"id":"q"})");
  Bytes frame{1, 1, 0, 0, 0};
  append(frame, ros2::encode(ros2::msg::Twist{}));
  viewer.send(frame);
  viewer.send(R"({"op":"nonsense"})");  // which is answered at once, so that all of it has come
  while (true) {
    const auto message = viewer.receive(kLong);
    ASSERT_TRUE(message);
    if (message->is_text && parse_json(std::string(as_text(message->bytes)))["op"] == "status") break;
  }
  server_->poll();
  EXPECT_EQ(commands_.size(), 1U) << "although it came last";
  EXPECT_LE(slow.asked, 2) << "each takes 1 ms, and none begins after 2 ms";
  EXPECT_TRUE(eventually([&] { return slow.asked == kQuestions; }));
}

TEST_F(FoxgloveServerOnLoopback, FromWithinALongCallbackWhatIsUrgentIsAnsweredAndNothingElse) {
  start();
  Viewer viewer(server_->port());
  hear(viewer, "advertiseServices");
  viewer.send(Bytes{2, 1, 0, 0, 0, 8, 0, 0, 0, 3, 0, 0, 0, 'c', 'd', 'r', 0, 1, 0, 0, 0});  // /arm
  viewer.send(Bytes{2, 2, 0, 0, 0, 9, 0, 0, 0, 3, 0, 0, 0, 'c', 'd', 'r', 0, 1, 0, 0, 0});
  const auto answered = [&] {
    const auto message = viewer.receive(milliseconds(5));
    return message && !message->is_text ? int{message->bytes.at(5)} : 0;  // the number of the call
  };
  const auto end = steady_clock::now() + kLong;
  int call = 0;
  while (call == 0 && steady_clock::now() < end) {
    server_->poll_urgent();
    call = answered();
  }
  EXPECT_EQ(call, 9);
  EXPECT_TRUE(eventually([&] { return answered() == 8; }));
}

/// A table whose values are being read.
class UnreadTable : public SmallTable {
 public:
  bool is_fresh() override { return read; }
  bool read = false;
};

TEST_F(FoxgloveServerOnLoopback, QuestionsAboutParametersThatAreBeingReadWaitAndAStopDoesNot) {
  start();
  UnreadTable table;
  server_->serve_parameters(table);
  Viewer viewer(server_->port());
  hear(viewer, "advertiseServices");
  viewer.send(R"({"op":"getParameters","parameterNames":[],"id":"all"})");
  viewer.send(R"({"op":"setParameters","parameters":[{"name":"b","value":1.5}],"id":"set"})");
  viewer.send(Bytes{2, 2, 0, 0, 0, 9, 0, 0, 0, 3, 0, 0, 0, 'c', 'd', 'r', 0, 1, 0, 0, 0});
  Bytes stopped{3, 2, 0, 0, 0, 9, 0, 0, 0, 3, 0, 0, 0, 'c', 'd', 'r'};
  append(stopped, ros2::encode(ros2::msg::Trigger::Response{true, "/emergency_stop"}));
  EXPECT_EQ(hear_binary(viewer), stopped);
  EXPECT_EQ(table.b, 0.2);
  table.read = true;
  EXPECT_EQ(hear(viewer, "parameterValues")["id"], "all");
  EXPECT_EQ(hear(viewer, "parameterValues")["id"], "set");
  EXPECT_EQ(table.b, 1.5);
}

TEST_F(FoxgloveServerOnLoopback, OtherwiseViewersMayOnlyLookAndStop) {
  start(false);
  Viewer viewer(server_->port());
  EXPECT_THAT(hear(viewer, "serverInfo")["capabilities"], testing::Not(testing::Contains("clientPublish")));
  const json services = hear(viewer, "advertiseServices")["services"];
  ASSERT_EQ(services.size(), 1U);
  EXPECT_EQ(services[0]["name"], "/emergency_stop");
  viewer.send(
      R"({"op":"advertise","channels":[{"id":1,"topic":"/cmd_vel","encoding":"cdr","schemaName":"geometry_msgs/msg/Twist"}]})");
  EXPECT_THAT(hear(viewer, "status")["message"], HasSubstr("does not take '/cmd_vel'"));
  viewer.send(R"({"op":"setParameters","parameters":[{"name":"b","value":1}],"id":"q"})");
  EXPECT_THAT(hear(viewer, "status")["message"], HasSubstr("may not change"));
  EXPECT_EQ(hear(viewer, "parameterValues")["parameters"][0]["value"], 0.2);
  EXPECT_EQ(table_.b, 0.2);
}

TEST_F(FoxgloveServerOnLoopback, AServiceAnswersOrSaysThatTheBytesAreNoRequest) {
  start();
  Viewer viewer(server_->port());
  hear(viewer, "advertiseServices");
  viewer.send(Bytes{2, 2, 0, 0, 0, 9, 0, 0, 0, 3, 0, 0, 0, 'c', 'd', 'r', 0, 1, 0, 0, 0});
  Bytes answer{3, 2, 0, 0, 0, 9, 0, 0, 0, 3, 0, 0, 0, 'c', 'd', 'r'};
  append(answer, ros2::encode(ros2::msg::Trigger::Response{true, "/emergency_stop"}));
  EXPECT_EQ(hear_binary(viewer), answer);
  viewer.send(Bytes{2, 2, 0, 0, 0, 10, 0, 0, 0, 3, 0, 0, 0, 'c', 'd', 'r', 9, 9});
  const json failure = hear(viewer, "serviceCallFailure");
  EXPECT_EQ(failure["callId"], 10);
  EXPECT_THAT(failure["message"], HasSubstr("no request"));
}

TEST_F(FoxgloveServerOnLoopback, ParametersAreReadSetAndRefused) {
  start();
  Viewer viewer(server_->port());
  viewer.send(R"({"op":"getParameters","parameterNames":[],"id":"all"})");
  json values = hear(viewer, "parameterValues");
  EXPECT_EQ(values["id"], "all");
  EXPECT_EQ(values["parameters"],
            parse_json(R"([{"name":"b","value":0.2,"type":"float64"},{"name":"name","value":"ASTRO"}])"));
  viewer.send(R"({"op":"setParameters","parameters":[{"name":"b","value":1}],"id":"set"})");
  values = hear(viewer, "parameterValues");
  EXPECT_EQ(values["id"], "set");
  EXPECT_EQ(values["parameters"][0]["value"], 1.0);
  EXPECT_EQ(table_.b, 1.0) << "a whole number for a real parameter";
  viewer.send(R"({"op":"setParameters","parameters":[{"name":"b","value":3.5}],"id":"bad"})");
  EXPECT_EQ(hear(viewer, "status")["message"], "b is above 2");
  EXPECT_EQ(hear(viewer, "parameterValues")["parameters"][0]["value"], 1.0);
}

TEST_F(FoxgloveServerOnLoopback, WhoWatchesAParameterHearsOfChangesByOthers) {
  start();
  Viewer watcher(server_->port()), other(server_->port());
  watcher.send(R"({"op":"subscribeParameterUpdates","parameterNames":["b"]})");
  EXPECT_EQ(hear(watcher, "parameterValues")["parameters"][0]["value"], 0.2);
  other.send(R"({"op":"setParameters","parameters":[{"name":"b","value":1.5}]})");
  EXPECT_EQ(hear(watcher, "parameterValues")["parameters"][0]["value"], 1.5);
  table_.b = 1.75;  // as another program would
  EXPECT_EQ(hear(watcher, "parameterValues")["parameters"][0]["value"], 1.75);
}

TEST_F(FoxgloveServerOnLoopback, ASlowViewerLosesTheOldestMessagesAndAFastOneNone) {
  start();
  Viewer fast(server_->port()), slow(server_->port(), {"", "foxglove.sdk.v1", 4096});
  for (Viewer* each : {&fast, &slow}) {
    hear(*each, "advertise");
    each->send(R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":1}]})");
    each->send(R"({"op":"getParameters","parameterNames":[],"id":"subscribed"})");
    hear(*each, "parameterValues");
  }
  // More than the queue (4 MiB), the batch and the system's buffers (hundreds of KiB) hold together.
  constexpr int kMessages = 800;
  const std::string filling(30'000, 'x');
  steady_clock::duration longest{};
  for (int i = 0; i < kMessages; ++i) {
    const auto begin = steady_clock::now();
    fast_->publish(text_message(filling), i);
    longest = std::max(longest, steady_clock::now() - begin);
    const Bytes got = hear_binary(fast);
    ASSERT_EQ(load<std::int64_t>(got, 5), i) << "the fast one loses none";
  }
  EXPECT_LT(longest, kLong) << "publish() does not wait";
  std::vector<std::int64_t> got;
  std::string warning;
  ASSERT_TRUE(eventually([&] {
    const auto message = slow.receive(milliseconds(5));
    if (message && message->is_text)
      warning = parse_json(std::string(as_text(message->bytes))).value("message", "");
    if (message && !message->is_text) got.push_back(load<std::int64_t>(message->bytes, 5));
    return !got.empty() && got.back() == kMessages - 1 && !warning.empty();
  })) << "the newest message reaches also the slow one";
  EXPECT_TRUE(std::is_sorted(got.begin(), got.end()));
  EXPECT_LT(got.size(), kMessages / 2U);
  EXPECT_THAT(warning, HasSubstr("messages were dropped"));
}

TEST_F(FoxgloveServerOnLoopback, AViewerThatOnlyAsksAndNeverReadsIsDisconnected) {
  start();
  Viewer silent(server_->port(), {"", "foxglove.sdk.v1", 4096});
  silent.send(R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":2}]})");
  const Bytes model = text_message(std::string(200'000, 'm'));
  EXPECT_TRUE(eventually([&] {
    model_->publish(model, 1);
    try {
      silent.send(R"({"op":"fly"})");
      return false;
    } catch (const std::exception&) {  // the other end is closed
      return true;
    }
  }));
}

TEST_F(FoxgloveServerOnLoopback, AMessageBeyondTheBoundEndsTheConnectionAndNoOther) {
  start();
  Viewer large(server_->port()), other(server_->port());
  large.send(Bytes((1 << 20) + 1, 1));
  EXPECT_TRUE(eventually([&] {
    large.receive(milliseconds(5));
    return large.ended();
  }));
  other.send(R"({"op":"getParameters","parameterNames":["b"]})");
  EXPECT_EQ(hear(other, "parameterValues")["parameters"].size(), 1U);
}

TEST_F(FoxgloveServerOnLoopback, ItsEndIsToldToTheViewers) {
  start();
  Viewer viewer(server_->port());
  hear(viewer, "serverInfo");
  fast_.reset();
  model_.reset();
  const auto begin = steady_clock::now();
  server_.reset();
  EXPECT_LT(steady_clock::now() - begin, kLong);
  while (!viewer.ended()) viewer.receive(milliseconds(100));
}

TEST_F(FoxgloveServerOnLoopback, APortInUseIsNamed) {
  start();
  Settings second;
  second.address.port = server_->port();
  EXPECT_THAT([&] { FoxgloveServer server(second); },
              support::ThrowsTelling(ServerProblem::port_taken, std::to_string(server_->port())));
  second.address.ip = "nowhere";
  EXPECT_THROW(FoxgloveServer{second}, Error);
}

}  // namespace
}  // namespace astro::foxglove
