#include <gmock/gmock.h>

#include <csignal>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>

#include "host/formats/cdr/codec.hpp"
#include "host/formats/messages/geometry.hpp"
#include "host/formats/messages/std.hpp"
#include "tests/host/live/foxglove/viewer.hpp"
#include "tests/support/base/json.hpp"
#include "tests/support/programs/program.hpp"

namespace astro::ros2 {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using support::eventually;
using support::parse_json;
using support::Simulator;
using support::Viewer;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

const std::vector<std::string> kRealTime;  // no options

/// `serve --foxglove` at a free port, ready when constructed.
class Served {
 public:
  Served(const Simulator& simulator, const std::vector<std::string>& options)
      : program_(command(simulator, options)) {
    if (!eventually([&] { return port() != 0 || !program_.running(); }) || port() == 0)
      throw std::runtime_error("nothing is served: " + program_.err());
  }
  std::uint16_t port() const {
    std::smatch match;
    const std::string said = program_.err();
    if (!std::regex_search(said, match, std::regex("ws://localhost:([0-9]+)"))) return 0;
    return static_cast<std::uint16_t>(std::stoi(match[1]));
  }
  support::Program& program() { return program_; }

 private:
  static std::vector<std::string> command(const Simulator& simulator,
                                          const std::vector<std::string>& options) {
    std::vector<std::string> words{ASTROLABE_PROGRAM, "serve",         "--foxglove", "--listen", "0",
                                   "--port",          simulator.port()};
    words.insert(words.end(), options.begin(), options.end());
    return words;
  }
  support::Program program_;
};

/// A viewer that subscribes to everything and keeps the newest message of each topic.
class Watcher {
 public:
  explicit Watcher(std::uint16_t port) : viewer_(port) {}

  void listen() {
    const auto message = viewer_.receive(milliseconds(20));
    if (!message) return;
    if (message->is_text) return take(parse_json(std::string(as_text(message->bytes))));
    const ByteView bytes(message->bytes);
    if (bytes[0] == 1)
      newest_[topics_.at(load<std::uint32_t>(bytes, 1))] = Bytes(bytes.begin() + 13, bytes.end());
    else
      answer_ = Bytes(bytes.begin() + 16, bytes.end());  // behind "cdr"
  }
  template <class Condition>
  bool hears(Condition condition) {
    return eventually([&] { return listen(), condition(); });
  }

  template <Message M>
  std::optional<M> newest(const std::string& topic) const {
    const auto found = newest_.find(topic);
    if (found == newest_.end()) return std::nullopt;
    return decode<M>(found->second);
  }
  msg::Trigger::Response call(const std::string& service) {
    answer_.clear();
    Bytes frame{2};
    append(frame, services_.at(service));
    append(frame, Bytes{1, 0, 0, 0, 3, 0, 0, 0, 'c', 'd', 'r'});
    append(frame, encode(msg::Trigger::Request{}));
    viewer_.send(frame);
    EXPECT_TRUE(hears([&] { return !answer_.empty(); })) << service;
    return decode<msg::Trigger::Response>(answer_).value_or(msg::Trigger::Response{});
  }
  bool offers(const std::string& service) const { return services_.contains(service); }
  Viewer& viewer() { return viewer_; }
  const json& information() const { return information_; }
  const json& parameters() const { return parameters_; }

 private:
  void take(const json& text) {
    if (text["op"] == "serverInfo") information_ = text;
    if (text["op"] == "parameterValues") parameters_ = text["parameters"];
    if (text["op"] == "advertiseServices")
      for (const json& each : text["services"]) services_[each["name"]] = each["id"];
    if (text["op"] != "advertise") return;
    json subscriptions = json::array();
    for (const json& each : text["channels"]) {
      topics_[each["id"]] = each["topic"];
      subscriptions.push_back({{"id", each["id"]}, {"channelId", each["id"]}});
    }
    viewer_.send(json{{"op", "subscribe"}, {"subscriptions", subscriptions}}.dump());
  }

  Viewer viewer_;
  json information_, parameters_;
  std::map<std::uint32_t, std::string> topics_;
  std::map<std::string, std::uint32_t> services_;
  std::map<std::string, Bytes> newest_;
  Bytes answer_;
};

TEST(Serve, AViewerSeesTheRobotItsModelAndItsGroundTruth) {
  Simulator simulator(kRealTime);
  Served served(simulator, {"--truth", "sim", "--rate", "100"});
  Watcher watcher(served.port());
  ASSERT_TRUE(watcher.hears([&] {
    return watcher.newest<msg::Odometry>("/odom") && watcher.newest<msg::PoseStamped>("/truth") &&
           watcher.newest<msg::TFMessage>("/tf_static") && watcher.newest<msg::String>("/robot_description");
  })) << served.program().err();
  EXPECT_THAT(watcher.newest<msg::String>("/robot_description")->data, HasSubstr("<robot"));
  const double odometry_s =
      1e-9 * static_cast<double>(msg::nanoseconds(watcher.newest<msg::Odometry>("/odom")->header.stamp));
  const double truth_s =
      1e-9 * static_cast<double>(msg::nanoseconds(watcher.newest<msg::PoseStamped>("/truth")->header.stamp));
  EXPECT_NEAR(odometry_s, truth_s, 5) << "both since 1970; either may be seconds old on a busy machine";
}

TEST(Serve, WithoutLeaveAViewerCanOnlyStopTheRobot) {
  Simulator simulator(kRealTime);
  Served served(simulator, {});
  Watcher watcher(served.port());
  ASSERT_TRUE(watcher.hears([&] { return watcher.offers("/emergency_stop"); }));
  EXPECT_FALSE(watcher.offers("/arm"));
  EXPECT_FALSE(watcher.offers("/reset_odometry"));
  EXPECT_THAT(watcher.information()["capabilities"], Not(Contains("clientPublish")));
  ASSERT_TRUE(watcher.hears([&] { return watcher.newest<msg::Odometry>("/odom").has_value(); }));
  EXPECT_TRUE(watcher.call("/emergency_stop").success);
  EXPECT_THAT(support::astrolabe({"info", "--port", simulator.port()}).out, HasSubstr("emergency"));
}

TEST(Serve, WithLeaveAViewerDrivesTheRobotAndSetsItsParameters) {
  Simulator simulator(kRealTime);
  support::forgive_late_hosts(simulator);
  Served served(simulator, {"--allow-commands"});
  Watcher watcher(served.port());
  ASSERT_TRUE(
      watcher.hears([&] { return watcher.offers("/arm") && watcher.newest<msg::Odometry>("/odom"); }));
  watcher.viewer().send(R"({"op":"setParameters","parameters":[{"name":"c_R","value":1.002}],"id":"1"})");
  ASSERT_TRUE(watcher.hears([&] { return !watcher.parameters().is_null(); }));
  EXPECT_NEAR(watcher.parameters()[0]["value"].get<double>(), 1.002,
              1e-9);  // a step of the robot's fixed point
  watcher.viewer().send(
      R"({"op":"advertise","channels":[{"id":1,"topic":"/cmd_vel","encoding":"cdr","schemaName":"geometry_msgs/msg/Twist"}]})");
  const msg::Trigger::Response armed = watcher.call("/arm");
  ASSERT_TRUE(armed.success) << armed.message;
  Bytes forward{1, 1, 0, 0, 0};
  append(forward, encode(msg::Twist{{0.2, 0, 0}, {0, 0, 0}}));
  EXPECT_TRUE(watcher.hears([&] {
    watcher.viewer().send(forward);
    return watcher.newest<msg::Odometry>("/odom")->pose.pose.position.x > 0.1;
  }));
  EXPECT_TRUE(watcher.call("/disarm").success);
}

TEST(Serve, EndsAtCtrlCAndTellsItsViewers) {
  Simulator simulator(kRealTime);
  Served served(simulator, {});
  Watcher watcher(served.port());
  ASSERT_TRUE(watcher.hears([&] { return !watcher.information().is_null(); }));
  served.program().send(SIGINT);
  EXPECT_EQ(served.program().wait(), 0);
  EXPECT_TRUE(watcher.hears([&] { return watcher.viewer().ended(); }));
}

TEST(Serve, ABareNumberAsThePortIsThatOfTheViewers) {
  support::Program program({ASTROLABE_PROGRAM, "serve", "--foxglove", "--port", "0"});  // any that is free
  EXPECT_TRUE(eventually([&] { return program.err().find("ws://localhost:") != std::string::npos; }));
  program.send(SIGTERM);
  EXPECT_EQ(program.wait(), 0);
}

TEST(Serve, WrongPortsAreRefusedAsWrongUsage) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"serve"},
        {"serve", "--foxglove", "--listen", "nowhere:70000"},
        {"serve", "--foxglove", "--port", "99999"},
        {"serve", "--foxglove", "--port", "8765", "--listen", "8766"}})
    EXPECT_EQ(support::astrolabe(words).code, 2) << words.back();
}

}  // namespace
}  // namespace astro::ros2
