#include "host/page/robot/robot_calls.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "host/page/robot/real_time.hpp"
#include "host/recording/run_file.hpp"
#include "tests/host/page/pages.hpp"

namespace astro::page {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class SimulatedRobot : public Pages {
 protected:
  SimulatedRobot() { opened_ = result("open", {{"simulated", {{"seed", 3}, {"slip", 0}}}}); }
  json opened_;
};

TEST_F(Pages, WithoutARobotEachCallSaysThatNoneIsOpen) {
  for (const char* call : {"arm", "stop", "emergency_stop", "drive", "path", "parameters", "stage", "watch"})
    EXPECT_THAT(sentence(ask(call)), HasSubstr("no robot is open")) << call;
  EXPECT_THAT(sentence(ask("open", {{"port", "/dev/ttyACM0"}})), HasSubstr("no ports here"));
  EXPECT_THAT(sentence(ask("fly")), HasSubstr("no call 'robot/fly'"));
  EXPECT_TRUE(result("ports")["ports"].empty());
}

TEST_F(SimulatedRobot, DescribesItself) {
  EXPECT_EQ(opened_["hardware"], "sim");
  EXPECT_TRUE(opened_["simulated"].get<bool>());
  std::map<std::string, json> parameters;
  for (const json& each : opened_["parameters"]) parameters[each["name"]] = each;
  EXPECT_EQ(parameters.at("command_timeout")["value"], 200);
  EXPECT_EQ(parameters.at("command_timeout")["unit"], "ms");
  EXPECT_EQ(parameters.at("c_R")["default"], 1);
  EXPECT_TRUE(parameters.at("robot_name")["value"].is_string());
  EXPECT_EQ(opened_["signals"].size(), signals().size());
}

TEST_F(SimulatedRobot, DrivesOnlyWhenItsPageHasArmedIt) {
  EXPECT_THAT(sentence(ask("drive", {{"v_mps", 0.3}, {"w_radps", 0}})), HasSubstr("not armed"));
  EXPECT_FALSE(state_after_ms(100)["armed"].get<bool>());
  result("arm");
  drive_ms(1000, 0.3);
  EXPECT_TRUE(state()["moving"].get<bool>());
  EXPECT_EQ(state()["mode"], "velocity");
  EXPECT_EQ(state()["driver"], kFirst);
}

TEST_F(SimulatedRobot, RestsWhenNobodyRepeatsItsVelocity) {
  result("arm");
  drive_ms(500, 0.3);
  // A quarter of a second holds the velocity, the ramp from 0.3 m/s at 0.5 m/s^2 takes 0.6 s, its jerk limit and the wheels a little more.
  EXPECT_FALSE(state_after_ms(1500)["moving"].get<bool>());
  EXPECT_EQ(state()["mode"], "idle");
  EXPECT_TRUE(state()["faults"].empty()) << "the velocity ended before the robot's own time-out";
  drive_ms(500, 0.3);
  EXPECT_TRUE(state()["moving"].get<bool>()) << "and the page drives on without arming again";
}

TEST_F(SimulatedRobot, AVelocityHoldsFromWhenItWasAskedFor) {
  const auto ms_until_rest = [&](milliseconds waited) {
    result("arm");
    drive_ms(1500, 0.3);
    calls().answer(kFirst, "robot/drive", {{"v_mps", 0.3}, {"w_radps", 0}}, waited);
    int ms = 0;
    for (; ms < 5000 && state()["mode"] != "idle"; ms += 10) run_ms(10);
    return ms;
  };
  // Time is looked at every 10 ms, and the robot's ticks and the link add a few.
  EXPECT_NEAR(ms_until_rest(milliseconds(0)) - ms_until_rest(milliseconds(200)), 200, 30);
  const json late = calls().answer(kFirst, "robot/drive", {{"v_mps", 0.3}}, DrivingCalls::kHold);
  EXPECT_THAT(sentence(late), HasSubstr("too late"));
}

TEST_F(SimulatedRobot, StopHoldsUntilItIsArmedAgain) {
  result("arm");
  drive_ms(500, 0.3);
  result("stop");
  EXPECT_THAT(sentence(ask("drive", {{"v_mps", 0.3}})), HasSubstr("stopped and must be armed again"));
  EXPECT_FALSE(state_after_ms(1500)["moving"].get<bool>());
  result("arm");
  drive_ms(500, 0.3);
  EXPECT_TRUE(state()["moving"].get<bool>());
}

TEST_F(SimulatedRobot, AnEmergencyStopIsAFaultWithItsRemedyUntilItIsCleared) {
  result("arm");
  drive_ms(500, 0.3);
  result("emergency_stop", json::object(), kSecond);
  const json stopped = state_after_ms(100);
  ASSERT_EQ(stopped["faults"].size(), 1U);
  EXPECT_EQ(stopped["faults"][0]["name"], "emergency_stop");
  EXPECT_THAT(stopped["faults"][0]["remedy"].get<std::string>(), HasSubstr("requested"));
  EXPECT_FALSE(stopped["armed"].get<bool>());
  EXPECT_THAT(sentence(ask("arm")), HasSubstr("emergency_stop"));
  result("clear_faults");
  result("arm");
}

TEST_F(SimulatedRobot, OnePageDrivesAnotherMayWatchAndStop) {
  result("arm");
  drive_ms(300, 0.3);
  for (const auto& [call, question] : std::map<std::string, json>{{"arm", json::object()},
                                                                  {"drive", {{"v_mps", 0.1}}},
                                                                  {"path", {{"kind", "line"}}},
                                                                  {"resume", json::object()},
                                                                  {"commit", json::object()},
                                                                  {"close", json::object()}})
    EXPECT_THAT(sentence(ask(call, question, kSecond)), HasSubstr("another page drives the robot")) << call;
  EXPECT_EQ(result("open", json::object(), kSecond)["page"], kSecond);
  result("watch", {{"signals", {"v"}}, {"rate_hz", 100}}, kSecond);
  drive_ms(300, 0.3);
  EXPECT_FALSE(events("samples", kSecond).empty());
  EXPECT_TRUE(events("samples", kFirst).empty());
  result("stop", json::object(), kSecond);
  EXPECT_FALSE(state_after_ms(1500)["moving"].get<bool>());
  EXPECT_NE(sentence(ask("drive", {{"v_mps", 0.3}})), "") << "the first page has to arm it again";
  result("arm", json::object(), kSecond);
  EXPECT_THAT(sentence(ask("drive", {{"v_mps", 0.3}})), HasSubstr("another page drives the robot"));
}

TEST_F(SimulatedRobot, WhenTheDrivingPageGoesTheRobotComesToRestAndIsDisarmed) {
  for (const bool on_path : {false, true}) {
    result("arm");
    if (on_path)
      result("path", {{"kind", "line"}, {"size_m", 3}});
    else
      drive_ms(300, 0.3);
    run_ms(1000 * on_path);
    ASSERT_TRUE(state()["moving"].get<bool>());
    calls().leave(kFirst);
    EXPECT_EQ(state_after_ms(50)["mode"], "stopping") << "at once";
    const json later = state_after_ms(2500);
    EXPECT_EQ(later["mode"], "disarmed");
    EXPECT_FALSE(later["moving"].get<bool>());
    EXPECT_FALSE(later["armed"].get<bool>());
  }
}

TEST_F(SimulatedRobot, ASoftRampIsNotCutShortWhenTheDrivingPageGoes) {
  result("stage", {{"name", "acceleration_limit"}, {"value", 0.05}});
  result("commit", {{"confirm", true}});
  result("arm");
  drive_ms(9000, 0.4);
  calls().leave(kFirst);
  EXPECT_EQ(state_after_ms(6000)["mode"], "stopping") << "0.4 m/s at 0.05 m/s^2 take 8 s";
  EXPECT_EQ(state_after_ms(5000)["mode"], "disarmed");
}

TEST_F(SimulatedRobot, ThatMovesIsBroughtToRestBeforeItIsDisarmed) {
  result("arm");
  drive_ms(500, 0.3);
  result("disarm");
  EXPECT_EQ(state_after_ms(50)["mode"], "stopping");
  const json later = state_after_ms(2500);
  EXPECT_EQ(later["mode"], "disarmed");
  EXPECT_FALSE(later["armed"].get<bool>());
  EXPECT_FALSE(later["moving"].get<bool>());
}

TEST_F(SimulatedRobot, WhenAPageThatOnlyWatchesGoesTheRobotDrivesOn) {
  result("arm");
  result("watch", {{"signals", {"v"}}}, kSecond);
  drive_ms(300, 0.3);
  calls().leave(kSecond);
  drive_ms(300, 0.3);
  EXPECT_EQ(state()["mode"], "velocity");
}

TEST_F(SimulatedRobot, DrivesASquareAndSaysHowFarItIs) {
  result("arm");
  EXPECT_EQ(result("path", {{"kind", "square"}, {"size_m", 0.5}, {"direction", "ccw"}})["segments"], 8);
  EXPECT_THAT(sentence(ask("drive", {{"v_mps", 0.1}})), HasSubstr("stop it first"));
  double before = 0;
  for (int i = 0; i < 400 && (events("path").empty() || events("path").back()["ended"].is_null()); ++i)
    run_ms(100);
  const std::vector<json> told = events("path");
  ASSERT_GT(told.size(), 50U);
  for (const json& each : told) {
    EXPECT_GE(each["done"].get<double>(), before - 0.01) << "odometry and events come in their own order";
    before = each["done"].get<double>();
  }
  EXPECT_EQ(told.back()["ended"], "finished");
  EXPECT_EQ(told.back()["done"], 1);
  result("watch", {{"signals", {"x", "y"}}});
  run_ms(100);
  const json pose = events("pose", kFirst).back();
  // The firmware's path control ends within a few millimetres by its own odometry.
  EXPECT_LT(std::hypot(pose["x_m"].get<double>(), pose["y_m"].get<double>()), 0.01);
  EXPECT_NEAR(pose["heading_rad"].get<double>(), 2 * 3.14159265, 0.02);
  // Its wheelbase is half a percent shorter than it believes, its wheels differ: 0.03 rad each, in the same direction.
  EXPECT_GT(std::abs(pose["truth"]["heading_rad"].get<double>() - pose["heading_rad"].get<double>()), 0.01);
}

TEST_F(SimulatedRobot, APathWaitsWhilePausedAndGoesOn) {
  result("arm");
  result("path", {{"kind", "line"}, {"size_m", 1}});
  run_ms(1500);
  result("pause", json::object(), kSecond);
  EXPECT_FALSE(state_after_ms(1500)["moving"].get<bool>());
  EXPECT_EQ(state()["mode"], "paused");
  result("resume");
  run_ms(6000);
  EXPECT_EQ(events("path").back()["ended"], "finished");
}

TEST_F(SimulatedRobot, AStopEndsThePath) {
  result("arm");
  result("path", {{"kind", "circle"}, {"size_m", 0.5}});
  run_ms(1000);
  result("stop");
  run_ms(1500);
  EXPECT_THAT(events("path").back()["ended"].get<std::string>(), HasSubstr("stopped"));
  EXPECT_FALSE(state()["moving"].get<bool>());
}

TEST_F(SimulatedRobot, SendsEachSampleOnceInBatches) {
  EXPECT_EQ(result("watch", {{"signals", {"left_speed", "battery"}}, {"rate_hz", 1000}})["rate_hz"], 1000);
  run_ms(100);
  events_.clear();
  run_ms(1000);
  const std::vector<json> batches = events("samples", kFirst);
  EXPECT_LE(batches.size(), 41U) << "at most 40 a second";
  EXPECT_GE(batches.size(), 20U);
  std::vector<double> times_s;
  for (const json& batch : batches) {
    EXPECT_EQ(batch["missed"], 0);
    ASSERT_EQ(batch["t_s"].size(), batch["signals"]["battery"].size());
    ASSERT_EQ(batch["t_s"].size(), batch["signals"]["left_speed"].size());
    for (const json& t_s : batch["t_s"]) times_s.push_back(t_s.get<double>());
  }
  // The link's own requests take a millisecond or two of the second now and then.
  EXPECT_NEAR(static_cast<double>(times_s.size()), 1000, 30);
  for (std::size_t i = 1; i < times_s.size(); ++i) EXPECT_NEAR(times_s[i] - times_s[i - 1], 0.001, 1e-9);
}

TEST_F(SimulatedRobot, ASlowerPageGetsFewerSamplesOfTheSameTelemetry) {
  result("watch", {{"signals", {"v"}}, {"rate_hz", 1000}});
  result("watch", {{"signals", {"v"}}, {"rate_hz", 50}}, kSecond);
  run_ms(1000);
  std::size_t fast = 0, slow = 0;
  for (const json& batch : events("samples", kFirst)) fast += batch["t_s"].size();
  for (const json& batch : events("samples", kSecond)) slow += batch["t_s"].size();
  EXPECT_NEAR(static_cast<double>(fast) / static_cast<double>(slow), 20, 1);
}

TEST_F(SimulatedRobot, ARateBetweenThoseOfTheTelemetryIsKeptOnAverage) {
  const double rate_hz = result("watch", {{"signals", {"v"}}, {"rate_hz", 33}})["rate_hz"];
  run_ms(3000);
  std::size_t samples = 0;
  for (const json& batch : events("samples", kFirst)) samples += batch["t_s"].size();
  // The first and the last sample, and those of the last batch, may be missing.
  EXPECT_NEAR(static_cast<double>(samples), 3 * rate_hz, 3);
}

TEST(SignalWatch, LosesNoSampleByStampsThatJitterAndKeepsNoneTwice) {
  SignalWatch watch({&signal_named("v")}, 1);
  for (const std::uint64_t stamp_us : {1000, 1999, 3001, 3001, 4000}) {
    protocol::Telemetry sample;
    sample.device_time_us = stamp_us;
    watch.take(sample, 1);
  }
  EXPECT_EQ((*watch.batch({}))["t_s"], json({0.001, 0.001999, 0.003001, 0.004}));
}

TEST_F(SimulatedRobot, SignalsAndRatesThatAreNoneAreNamed) {
  EXPECT_THAT(sentence(ask("watch", {{"signals", {"speed"}}})), HasSubstr("no signal 'speed'"));
  EXPECT_THAT(sentence(ask("watch", {{"signals", {"v"}}, {"rate_hz", 1001}})), HasSubstr("from 1 to 1000"));
}

TEST_F(SimulatedRobot, ParametersAreStagedAndPutInForceTogether) {
  EXPECT_EQ(result("stage", {{"name", "c_R"}, {"value", 1.002}})["staged"]["c_R"], 1.002);
  result("stage", {{"name", "robot_name"}, {"value", "ares"}});
  std::map<std::string, json> now;
  const json committed = result("commit");
  for (const json& each : committed["parameters"]) now[each["name"]] = each;
  EXPECT_EQ(now.at("c_R")["value"], 1.002);
  EXPECT_EQ(now.at("robot_name")["value"], "ares");
  EXPECT_TRUE(now.at("c_R")["staged"].is_null());
}

TEST_F(SimulatedRobot, WhatTheRobotDoesNotAllowIsRefusedByName) {
  EXPECT_THAT(sentence(ask("stage", {{"name", "c_R"}, {"value", 17}})), HasSubstr("c_R"));
  EXPECT_THAT(sentence(ask("stage", {{"name", "c_X"}, {"value", 1}})), HasSubstr("no parameter 'c_X'"));
  EXPECT_THAT(sentence(ask("stage", {{"name", "c_R"}})), HasSubstr("value is neither"));
}

TEST_F(SimulatedRobot, WhatAPersonHasToConfirmIsPutInForceOnlyThen) {
  for (const auto& [name, value] :
       std::map<std::string, double>{{"command_timeout", 0}, {"c_L", -1}, {"b", 0.6}}) {
    const json staged = ask("stage", {{"name", name}, {"value", value}});
    if (staged.contains("error")) continue;  // its table does not allow a wheel that turns backwards
    EXPECT_EQ(staged["result"]["far"].size(), 1U) << name;
    const json refused = ask("commit");
    EXPECT_THAT(sentence(refused), HasSubstr("a person has to confirm")) << name;
    EXPECT_THAT(refused["error"]["remedies"], ElementsAre("confirm"));
    EXPECT_NE(value_in(result("parameters"), name), value);
    EXPECT_EQ(value_in(result("commit", {{"confirm", true}}), name), value);
  }
}

TEST_F(SimulatedRobot, ADiscardedValueIsForgotten) {
  result("stage", {{"name", "command_timeout"}, {"value", 0}});
  EXPECT_TRUE(result("discard")["staged"].empty());
  EXPECT_EQ(value_in(result("commit"), "command_timeout"), 200);
}

TEST_F(SimulatedRobot, APagePutsInForceOnlyWhatItHasStagedItself) {
  result("stage", {{"name", "command_timeout"}, {"value", 0}});
  EXPECT_EQ(result("stage", {{"name", "c_R"}, {"value", 1.002}}, kSecond)["staged"].size(), 1U);
  const json committed = result("commit", {{"confirm", true}}, kSecond);
  EXPECT_EQ(value_in(committed, "c_R"), 1.002);
  EXPECT_EQ(value_in(committed, "command_timeout"), 200);
  calls().leave(kFirst);
  EXPECT_EQ(value_in(result("commit", {{"confirm", true}}), "command_timeout"), 200)
      << "what a page has staged ends with it";
}

TEST_F(SimulatedRobot, ParametersAreNotCommittedWhileItMoves) {
  result("stage", {{"name", "c_R"}, {"value", 1.002}});
  result("arm");
  drive_ms(500, 0.3);
  EXPECT_THAT(sentence(ask("commit")), HasSubstr("must be at rest"));
}

TEST_F(SimulatedRobot, RecordsAFileThatACalibrationReads) {
  const std::string file = result("record", {{"on", true}})["file"];
  EXPECT_NE(sentence(ask("record", {{"on", true}})), "");
  result("arm");
  result("path", {{"kind", "line"}, {"size_m", 0.5}});
  run_ms(4000);
  EXPECT_EQ(state()["recording"], file);
  EXPECT_EQ(result("record", {{"on", false}})["file"], file);
  const recording::Run run = recording::read_run(folder_.path() / file);
  EXPECT_EQ(run.info.kind, "free");
  EXPECT_EQ(run.info.parameters.at("command_timeout"), 200);
  ASSERT_GT(run.odometry.size(), 150U) << "four seconds at 50 Hz";
  ASSERT_GT(run.truth.size(), 200U) << "and 60 Hz";
  EXPECT_NEAR(std::hypot(run.odometry.back().x_m, run.odometry.back().y_m), 0.5, 0.01);
  EXPECT_NE(sentence(ask("record", {{"on", false}})), "");
}

TEST_F(SimulatedRobot, ARecordingIsOfferedUntilAPageHasItRemoved) {
  const std::string file = result("record", {{"on", true}})["file"];
  calls().leave(kFirst);
  EXPECT_EQ(state_after_ms(1000)["recording"], file) << "it goes on when a page is closed";
  EXPECT_TRUE(state()["recordings"].empty());
  result("close", json::object(), kSecond);
  EXPECT_FALSE(state()["open"].get<bool>());
  EXPECT_EQ(state()["recording"], nullptr);
  EXPECT_EQ(state()["recordings"], json({file})) << "the end of the robot ends it, and nobody has it yet";
  EXPECT_FALSE(recording::read_run(folder_.path() / file).odometry.empty());
  result("remove_recording", {{"file", "another.mcap"}});
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / file));
  result("remove_recording", {{"file", file}});
  calls().step({});
  EXPECT_TRUE(state()["recordings"].empty());
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / file)) << "it takes no memory any more";
}

class KeptRecordings : public Pages {
 protected:
  KeptRecordings() {
    recordings_.keep = [this](const std::filesystem::path& file) {
      kept_.push_back(recording::read_run(file).odometry.size());
    };
  }
  std::vector<std::size_t> kept_;  // samples of each recording
};

TEST_F(KeptRecordings, WhateverNoPageHasRemovedIsKeptAtTheEnd) {
  result("open", {{"simulated", json::object()}});
  for (const bool removed : {false, true}) {
    result("record", {{"on", true}});
    run_ms(1000);
    const json ended = result("record", {{"on", false}});
    if (removed) result("remove_recording", ended);
  }
  result("record", {{"on", true}});
  run_ms(2000);
  calls_.reset();
  // A sample each 20 ms, but for those on the way.
  ASSERT_EQ(kept_.size(), 2U) << "the first, and the one that was under way";
  EXPECT_NEAR(static_cast<double>(kept_[0]), 50, 10);
  EXPECT_NEAR(static_cast<double>(kept_[1]), 100, 10);
}

TEST_F(Pages, ARecordingEndsWhenThereIsNoMoreRoomAndIsOffered) {
  recordings_.most_bytes = 100'000;
  result("open", {{"simulated", json::object()}});
  const std::string file = result("record", {{"on", true}})["file"];
  for (int s = 0; s < 120 && state_after_ms(1000)["recording"] == file;) ++s;
  EXPECT_EQ(state()["recordings"], json({file}));
  EXPECT_THAT(events("notice").back()["sentence"].get<std::string>(), HasSubstr("all the room"));
  // A chunk of some seconds is written at a time, and the file's index at its end.
  const auto bytes = std::filesystem::file_size(folder_.path() / file);
  EXPECT_GE(bytes, recordings_.most_bytes);
  EXPECT_LT(bytes, 2 * recordings_.most_bytes);
  EXPECT_GT(recording::read_run(folder_.path() / file).odometry.size(), 100U);
  EXPECT_THAT(sentence(ask("record", {{"on", true}})), HasSubstr("save them, and remove what is saved"));
  result("remove_recording", {{"file", file}});
  result("record", {{"on", true}});
}

TEST_F(SimulatedRobot, ClosingLeavesItDisarmedAndAnotherOneMayBeOpened) {
  EXPECT_THAT(sentence(ask("open", {{"simulated", json::object()}})), HasSubstr("close it first"));
  result("arm");
  drive_ms(300, 0.3);
  result("close");
  EXPECT_TRUE(state_after_ms(50)["moving"].get<bool>()) << "nobody waits for its ramp";
  for (const char* call : {"open", "arm"})
    EXPECT_THAT(sentence(ask(call)), HasSubstr("ask again")) << call << " comes too early";
  EXPECT_FALSE(state_after_ms(2000)["open"].get<bool>());
  result("open", {{"simulated", json::object()}});
  EXPECT_FALSE(state_after_ms(100)["armed"].get<bool>());
}

TEST_F(SimulatedRobot, AtRestIsClosedAtOnce) {
  result("arm");
  run_ms(100);
  result("close");
  EXPECT_FALSE(state()["open"].get<bool>());
}

TEST_F(SimulatedRobot, AnEmergencyStopDoesNotWaitForTheRampOfAClose) {
  result("arm");
  drive_ms(1500, 0.5);
  result("close");
  run_ms(50);
  result("emergency_stop", json::object(), kSecond);
  run_ms(20);
  EXPECT_FALSE(state()["open"].get<bool>()) << "the motors are off, and there is nothing to wait for";
}

TEST_F(RobotAtAPort, IsListedAndOpenedByItsPath) {
  EXPECT_EQ(result("ports")["ports"][0]["path"], "/dev/robot");
  const json told = result("open", {{"port", "/dev/robot"}});
  EXPECT_EQ(opened_, "/dev/robot");
  EXPECT_FALSE(told["simulated"].get<bool>());
  result("watch", {{"signals", {"v"}}});
  run_ms(100);
  EXPECT_TRUE(events("pose", kFirst).back()["truth"].is_null()) << "nobody knows where a real robot is";
}

TEST_F(RobotAtAPort, ThatIsNotThereIsAnError) {
  cable_.pull();
  EXPECT_THAT(sentence(ask("open", {{"port", "/dev/robot"}})), HasSubstr("there is no port"));
  EXPECT_FALSE(result("ports").empty());
  cable_.plug_in();
  result("open", {{"port", "/dev/robot"}});
}

TEST_F(RobotAtAPort, WhenTheLinkIsLostItIsSaidAndItIsFoundAgainButNotArmed) {
  result("open", {{"port", "/dev/robot"}});
  result("arm");
  drive_ms(500, 0.3);
  ASSERT_TRUE(moves());
  cable_.pull();
  pass_ms(100);
  EXPECT_EQ(state()["link"], "lost");
  EXPECT_THAT(state()["why"].get<std::string>(), HasSubstr("there is no port"));
  EXPECT_THAT(sentence(ask("drive", {{"v_mps", 0.3}})), HasSubstr("link to the robot is lost"));
  pass_ms(2000);
  EXPECT_FALSE(moves()) << "by its own time-out";
  cable_.plug_in();
  pass_ms(300);
  run_ms(500);
  EXPECT_EQ(state()["link"], "up");
  EXPECT_FALSE(state()["armed"].get<bool>());
  EXPECT_THAT(sentence(ask("drive", {{"v_mps", 0.3}})), HasSubstr("not armed"));
}

TEST_F(RobotAtAPort, IsAtRestWhenTheProgramEnds) {
  result("open", {{"port", "/dev/robot"}});
  result("arm");
  drive_ms(500, 0.3);
  ASSERT_TRUE(moves());
  calls_.reset();
  EXPECT_FALSE(moves());
  EXPECT_EQ(support::drive_of(*robot_).mode(), protocol::Mode::disarmed);
}

TEST_F(RobotAtAPort, ThatDrivesWithoutATimeOutIsStoppedWhenItIsOpened) {
  {
    robot::Client killed(std::make_unique<simulation::InProcessTransport>(robot_, 1));
    killed.connect();
    auto parameters = robot::RemoteParameters::fetch(killed);
    parameters.stage("command_timeout", 0.0);
    parameters.commit();
    killed.request(protocol::Arm{});
    killed.request(protocol::Velocity{300'000, 0});
  }
  for (int i = 0; i < 1000; ++i) robot_->step();
  ASSERT_TRUE(moves());
  result("open", {{"port", "/dev/robot"}});
  run_ms(2000);
  EXPECT_FALSE(moves());
}

TEST(RealTime, FollowsTheWallAndDoesNotMakeUpForAHiddenTab) {
  RealTime pace;
  const auto due_ms = [&](int wall, int robot) {
    return pace.due(milliseconds(wall), milliseconds(robot)).count() / 1000;
  };
  EXPECT_EQ(due_ms(1000, 5000), 0);
  EXPECT_EQ(due_ms(1020, 5000), 20);
  EXPECT_EQ(due_ms(1040, 5023), 17) << "requests let 3 ms pass, too";
  EXPECT_EQ(due_ms(1050, 5080), 0);
  EXPECT_EQ(due_ms(61'000, 5080), 250);
  EXPECT_EQ(due_ms(61'020, 5330), 20) << "the minute is forgotten";
  EXPECT_EQ(due_ms(61'040, 95'330), 0) << "a measurement was driven at once";
  EXPECT_EQ(due_ms(61'060, 95'330), 20) << "and nobody waits for the wall to follow";
}

}  // namespace
}  // namespace astro::page
