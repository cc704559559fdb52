#include "host/page/robot/measurements.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>

#include "tests/host/page/pages.hpp"

namespace astro::page {
namespace {

using testing::HasSubstr;

/// As somebody has just built it.
class BuiltRobot : public Pages {
 protected:
  void build(json robot) {
    robot["slip"] = 0;
    result("open", {{"simulated", robot}});
  }
  /// What the picture of a simulated robot shows when this motor is driven: one wheel turns.
  json seen(const std::string& motor) {
    const json turned = result("probe_motor", {{"motor", motor}})["turned"];
    const double left = turned["left"], right = turned["right"];
    const bool is_left = std::abs(left) > std::abs(right);
    EXPECT_GT(std::abs(is_left ? left : right), 0.05) << "of a turn can be seen";
    return {{"wheel", is_left ? "left" : "right"}, {"forward", (is_left ? left : right) > 0}};
  }
  json look_at_both() {
    return result("judge_wiring", {{"saw", {{"left", seen("left")}, {"right", seen("right")}}}});
  }
  void load(const json& values) {
    for (const auto& [name, value] : values.items()) result("stage", {{"name", name}, {"value", value}});
    result("commit", {{"confirm", true}});
  }
};

std::vector<std::string> faults(const json& wires) {
  std::vector<std::string> found;
  for (const json& each : wires["findings"]) found.push_back(each["fault"]);
  return found;
}

TEST_F(BuiltRobot, SwappedMotorsAndAReversedEncoderAreFoundByWhatAPersonSees) {
  build({{"wiring", {"motors-swapped", "right-encoder-reversed"}}});
  const json wires = look_at_both();
  EXPECT_THAT(faults(wires), testing::UnorderedElementsAre("motors_swapped", "right_encoder_reversed"));
  EXPECT_TRUE(wires["needs_hands"].get<bool>());
  EXPECT_EQ(wires["parameters"], json({{"encoder_polarity_right", -1}}));
}

TEST_F(BuiltRobot, WhatParametersCanMendIsInOrderOnceTheyAreLoaded) {
  build({{"wiring", {"left-motor-reversed", "right-encoder-reversed"}}});
  load(look_at_both()["parameters"]);
  EXPECT_THAT(faults(look_at_both()), testing::IsEmpty());
}

TEST_F(BuiltRobot, WiresAreJudgedOnlyOnceBothMotorsWereDriven) {
  build(json::object());
  seen("left");
  EXPECT_THAT(sentence(ask("judge_wiring")), HasSubstr("the right motor was not driven yet"));
  seen("right");
  EXPECT_TRUE(result("judge_wiring")["needs_eyes"].get<bool>()) << "nobody said what was seen";
}

TEST_F(BuiltRobot, WrongCountsShowWhenItIsRolledByHand) {
  build({{"counts_per_motor_rev", 32}});
  EXPECT_THAT(sentence(ask("roll", {{"turns", 10}})), HasSubstr("begin again"));
  const auto rolled = [&] {
    result("roll", {{"begin", true}});
    const double turns = result("push", {{"turns", 10}})["turns"];
    EXPECT_NEAR(turns, 10.5, 0.5) << "the wheels roll on a little";
    return result("roll", {{"turns", turns}});
  };
  const json wrong = rolled();
  EXPECT_FALSE(wrong["agrees"].get<bool>());
  EXPECT_EQ(wrong["parameters"], json({{"counts_per_motor_rev", 32}}));
  load(wrong["parameters"]);
  EXPECT_TRUE(rolled()["agrees"].get<bool>());
  EXPECT_THAT(sentence(ask("roll", {{"turns", 10}, {"distance_m", 2}})), HasSubstr("how far"));
}

TEST_F(BuiltRobot, ARollBeginsWhateverFaultCameJustNow) {
  build(json::object());
  result("emergency_stop");
  result("roll", {{"begin", true}});
}

TEST_F(BuiltRobot, IsTunedLoadedAndMeasuredAgain) {
  build(json::object());
  EXPECT_THAT(sentence(ask("load_tuning")), HasSubstr("tune first"));
  const json found = result("tune");
  EXPECT_FALSE(found["loaded"].get<bool>());
  EXPECT_FALSE(found["changes"].empty());
  EXPECT_FALSE(events("measuring", kFirst).empty());
  const json loaded = result("load_tuning");
  EXPECT_TRUE(loaded["was_measured"].get<bool>());
  const json parameters = result("parameters");
  for (const json& each : found["changes"])
    EXPECT_NEAR(value_in(parameters, each["name"]).get<double>(), each["after"].get<double>(), 1e-4);
  EXPECT_FALSE(state_after_ms(100)["armed"].get<bool>());
}

TEST_F(BuiltRobot, IsCalibratedAndItsParametersAreWrittenToAFile) {
  build({{"E_d", 1.004}});
  const json told = result("experiment", {{"runs", 2}, {"side_m", 1}});
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / told["report"].get<std::string>()));
  EXPECT_FALSE(events("way", kFirst).empty());
  const json parameters = result("parameters");
  // Without slip four squares of 1 m show E_d to far better than this.
  EXPECT_NEAR(value_in(parameters, "c_R").get<double>() / value_in(parameters, "c_L").get<double>(), 1.004,
              2e-4);
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / result("export")["file"].get<std::string>()));
}

TEST_F(BuiltRobot, UnknownFaultsOfItsWiresAreRefused) {
  EXPECT_THAT(sentence(ask("open", {{"simulated", {{"wiring", {"legs-swapped"}}}}})),
              HasSubstr("'legs-swapped' is not a wiring fault"));
}

TEST_F(BuiltRobot, IsNotMeasuredWhileAnotherPageDrivesItOrItIsRecorded) {
  build(json::object());
  result("arm", json::object(), kSecond);
  EXPECT_THAT(sentence(ask("tune")), HasSubstr("another page drives"));
  result("disarm", json::object(), kSecond);
  result("record", {{"on", true}});
  EXPECT_THAT(sentence(ask("probe_motor", {{"motor", "left"}})), HasSubstr("recording is under way"));
}

TEST_F(BuiltRobot, ThatIsArmedIsBroughtToRestBeforeItIsMeasured) {
  build(json::object());
  result("arm");
  drive_ms(500, 0.3);
  seen("left");
  EXPECT_FALSE(state_after_ms(100)["armed"].get<bool>());
}

/// At a cable, and a page asks something while it is measured.
class MeasuredAtAPort : public RobotAtAPort {
 protected:
  /// Tunes it, and asks this once it drives.
  json tune_and(const std::string& call) {
    result("open", {{"port", "/dev/robot"}});
    bool asked = false;
    meanwhile_ = [&, call] {
      if (asked || !moves()) return false;
      asked = true;
      meanwhile_answer_ = ask(call, json::object(), kSecond);
      return false;
    };
    const json told = ask("tune");
    meanwhile_ = [] { return false; };
    EXPECT_TRUE(asked);
    return told;
  }
  json meanwhile_answer_;
};

TEST_F(MeasuredAtAPort, SaysThatItIsMeasuredAndForWhom) {
  EXPECT_TRUE(tune_and("parameters").contains("result"));
  EXPECT_THAT(sentence(meanwhile_answer_), HasSubstr("is being measured"));
  bool measuring = false;
  for (const json& each : events("state"))
    measuring |= each["mode"] == "measuring" && each["moving"] == true && each["driver"] == kFirst;
  EXPECT_TRUE(measuring);
  EXPECT_EQ(state_after_ms(100)["mode"], "disarmed");
}

TEST_F(MeasuredAtAPort, AStopOfAnyPageEndsTheMeasurementAtRestAndDisarmed) {
  EXPECT_THAT(sentence(tune_and("stop")), HasSubstr("at rest and disarmed"));
  EXPECT_TRUE(meanwhile_answer_.contains("result"));
  EXPECT_FALSE(moves());
  EXPECT_EQ(state_after_ms(100)["mode"], "disarmed");
}

TEST_F(MeasuredAtAPort, AnEmergencyStopOpensTheBridgesAtOnce) {
  EXPECT_THAT(sentence(tune_and("emergency_stop")), HasSubstr("the emergency stop ended the measurement"));
  EXPECT_TRUE(meanwhile_answer_.contains("result"));
  EXPECT_EQ(state_after_ms(100)["faults"][0]["name"], "emergency_stop");
}

TEST_F(MeasuredAtAPort, AnEmergencyStopDoesNotWaitForTheRampOfAMeasurement) {
  result("open", {{"port", "/dev/robot"}});
  bool open_at_once = false;
  meanwhile_ = [&] {
    if (mode() != protocol::Mode::stopping) return false;
    ask("emergency_stop", json::object(), kSecond);
    open_at_once = mode() == protocol::Mode::fault && moves();
    return false;
  };
  EXPECT_THAT(sentence(ask("tune")), HasSubstr("emergency"));
  EXPECT_TRUE(open_at_once) << "and it rolled on";
}

TEST_F(MeasuredAtAPort, AnEmergencyStopDoesNotWaitForTheRampBeforeAMeasurement) {
  result("open", {{"port", "/dev/robot"}});
  result("arm");
  drive_ms(500, 0.3);
  bool open_at_once = false;
  meanwhile_ = [&] {
    if (mode() != protocol::Mode::stopping) return false;
    ask("emergency_stop", json::object(), kSecond);
    open_at_once = mode() == protocol::Mode::fault && moves();
    return false;
  };
  EXPECT_THAT(sentence(ask("tune")), HasSubstr("before anything was measured"));
  EXPECT_TRUE(open_at_once) << "and it rolled on";
  EXPECT_EQ(state_after_ms(100)["faults"][0]["name"], "emergency_stop");
}

TEST_F(MeasuredAtAPort, AStopThatWaitsAlreadyEndsTheMeasurementBeforeItsFirstVoltage) {
  result("open", {{"port", "/dev/robot"}});
  bool moved = false;
  meanwhile_ = [&, asked = false]() mutable {
    moved |= moves();
    if (!std::exchange(asked, true)) {
      EXPECT_EQ(state()["driver"], kFirst) << "the page knows already that it has to stop it";
      ask("stop");
    }
    return false;
  };
  EXPECT_THAT(sentence(ask("probe_motor", {{"motor", "left"}})), HasSubstr("before anything was measured"));
  EXPECT_FALSE(moved);
  EXPECT_EQ(state_after_ms(100)["mode"], "disarmed");
}

TEST_F(MeasuredAtAPort, APageThatComesMeanwhileSeesTheRobotAndMayStopIt) {
  result("open", {{"port", "/dev/robot"}});
  json seen;
  meanwhile_ = [&] {
    if (!moves() || !seen.is_null()) return false;
    seen = result("open", json::object(), kSecond);
    result("stop", json::object(), kSecond);
    return false;
  };
  EXPECT_THAT(sentence(ask("tune")), HasSubstr("at rest and disarmed"));
  EXPECT_EQ(seen["page"], kSecond);
  EXPECT_FALSE(seen["parameters"].empty());
}

TEST_F(MeasuredAtAPort, ARollDoesNotGoOnOnceTheLinkWasLost) {
  result("open", {{"port", "/dev/robot"}});
  result("roll", {{"begin", true}});
  cable_.pull();
  run_ms(100);
  cable_.plug_in();
  pass_ms(5000);
  run_ms(500);
  ASSERT_EQ(state()["link"], "up");
  EXPECT_THAT(sentence(ask("roll", {{"turns", 10}})), HasSubstr("begin again")) << "it may have restarted";
}

TEST_F(MeasuredAtAPort, WhatADriveRemarksIsTold) {
  result("open", {{"port", "/dev/robot"}});
  result("arm");
  drive_ms(300, 0.3);
  cable_.pull();
  run_ms(100);
  pass_ms(5000);
  cable_.plug_in();
  pass_ms(1000);
  ASSERT_FALSE(state_after_ms(500)["faults"].empty()) << "by its own time-out";
  result("probe_motor", {{"motor", "left"}});
  EXPECT_THAT(events("notice", kFirst).at(0)["sentence"].get<std::string>(), HasSubstr("cleared"));
}

TEST_F(MeasuredAtAPort, ThePageThatAskedGoesAndTheMeasurementEnds) {
  result("open", {{"port", "/dev/robot"}});
  meanwhile_ = [&] {
    if (moves()) calls().leave(kFirst);
    return false;
  };
  EXPECT_THAT(sentence(ask("tune")), HasSubstr("at rest and disarmed"));
  EXPECT_FALSE(moves());
}

TEST_F(MeasuredAtAPort, NobodyPushesARealRobotOrKnowsWhereItIs) {
  result("open", {{"port", "/dev/robot"}});
  EXPECT_THAT(sentence(ask("push")), HasSubstr("by hand"));
  EXPECT_THAT(sentence(ask("experiment")), HasSubstr("tracker"));
}

TEST_F(MeasuredAtAPort, ALinkThatIsLostDuringAMeasurementIsSaidAndFoundAgain) {
  result("open", {{"port", "/dev/robot"}});
  meanwhile_ = [&] {
    if (moves()) cable_.pull();
    return false;
  };
  EXPECT_NE(sentence(ask("tune")), "");
  EXPECT_EQ(state()["link"], "lost");
  meanwhile_ = [] { return false; };
  cable_.plug_in();
  pass_ms(5000);
  run_ms(500);
  EXPECT_EQ(state()["link"], "up");
  EXPECT_FALSE(state()["armed"].get<bool>());
  EXPECT_FALSE(moves()) << "by its own time-out, which is a fault";
}

}  // namespace
}  // namespace astro::page
