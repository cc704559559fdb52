#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/page/robot/robot_calls.hpp"
#include "tests/support/base/temporary_folder.hpp"
#include "tests/support/ros2/robot_on_ros.hpp"

/// Pages that ask for a robot.
namespace astro::page {

using nlohmann::json;
using std::chrono::milliseconds;

inline std::string sentence(const json& answer) {
  return answer.contains("error") ? answer["error"]["sentence"].get<std::string>() : "";
}

/// The value of a parameter in the answer to a call.
inline json value_in(const json& told, const std::string& name) {
  for (const json& each : told.at("parameters"))
    if (each["name"] == name) return each["value"];
  return nullptr;
}

/// Pages and their calls, without a network. Time is that of the robot and passes in run_ms() alone.
class Pages : public testing::Test {
 protected:
  static constexpr Page kFirst = 1, kSecond = 2;

  json ask(const std::string& call, const json& question = json::object(), Page page = kFirst) {
    return calls().answer(page, "robot/" + call, question);
  }
  json result(const std::string& call, const json& question = json::object(), Page page = kFirst) {
    const json told = ask(call, question, page);
    EXPECT_TRUE(told.contains("result")) << call << ": " << told;
    return told.value("result", json());
  }
  RobotCalls& calls() {
    if (!calls_)
      calls_.emplace(
          ports_, recordings_,
          [this](Page page, const json& event) {
            events_.push_back({page, event});
          },
          [this] { return meanwhile_(); });
    return *calls_;
  }

  void run_ms(int ms) {
    for (int passed = 0; passed < ms; passed += 10) calls().step(milliseconds(10));
  }
  /// Asks for a velocity as a page does while a key is held down.
  void drive_ms(int ms, double v_mps, Page page = kFirst) {
    for (int passed = 0; passed < ms; passed += 100) {
      ask("drive", {{"v_mps", v_mps}, {"w_radps", 0}}, page);
      run_ms(100);
    }
  }

  std::vector<json> events(const std::string& kind, Page page = RobotCalls::kAllPages) const {
    std::vector<json> found;
    for (const auto& [to, event] : events_)
      if (event.at("event") == kind && to == page) found.push_back(event);
    return found;
  }
  json state() const { return events("state").back(); }
  /// What a robot says once it had time to say it.
  json state_after_ms(int ms) {
    run_ms(ms);
    return state();
  }

  RobotPorts ports_;
  RobotCalls::Meanwhile meanwhile_ = [] { return false; };
  test::TemporaryFolder folder_;
  RecordingPlace recordings_{.folder = folder_.path()};
  std::vector<std::pair<Page, json>> events_;
  std::optional<RobotCalls> calls_;
};

/// A robot at the end of a cable.
class RobotAtAPort : public Pages {
 protected:
  RobotAtAPort() {
    ports_.list = [] { return std::vector<RobotPort>{{"/dev/robot", "astro"}}; };
    ports_.open = [this](const std::string& path) {
      opened_ = path;
      return cable_.open();
    };
    ports_.clock = {[this] { return microseconds(static_cast<std::int64_t>(robot_->board().world_us())); },
                    [] { return std::int64_t{0}; }};
  }
  /// A lost link lets no time pass.
  void pass_ms(int ms) {
    for (int i = 0; i < ms; ++i) {
      robot_->step();
      calls().step({});
    }
  }
  protocol::Mode mode() { return support::drive_of(*robot_).mode(); }
  bool moves() { return !support::drive_of(*robot_).wheels().stopped(); }

  std::shared_ptr<simulation::VirtualRobot> robot_ =
      std::make_shared<simulation::VirtualRobot>(support::RobotOnRos::quiet(), simulation::MocapConfig{});
  support::Cable cable_{robot_};
  std::string opened_;
};

}  // namespace astro::page
