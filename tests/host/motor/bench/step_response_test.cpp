#include "host/motor/bench/step_response.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "tests/host/motor/bench/rig.hpp"

namespace astro::motor {
namespace {

using motor::design_gains;
using motor::StepFigures;
using motor::WheelLoop;

struct Both {
  StepFigures measured, predicted;
};

/// The step of the left wheel on a robot that carries these parameters, against the prediction from the data
/// sheet. Nothing is measured beforehand: the model is the truth.
Both step(bool on_stand, const std::map<std::string, robot::Value>& values, double speed_mps) {
  support::Desk desk(quiet_robot(on_stand));
  set(desk, values);
  const RobotFacts facts = facts_on(desk);
  Bench bench(desk.client, facts);
  robot::DriveSession session(desk.client);
  const StepCourse measured = measure_step(bench, session, speed_mps, 1.5)[0];
  const WheelLoop loop{from_data_sheet(1, on_stand), 1.0,  facts.feed_forward[0], facts.kp, facts.ki,
                       facts.observer_radps,         12.0, facts.count_m[0]};
  return {figures(measured), figures(predicted(measured, loop))};
}

// A jump with feed-forward overshoots and is braked. The gear helps there by what it loses, which the model
// does not know: it then predicts too much.
constexpr double kDrives = 0.01, kBrakes = 0.07;

void expect_alike(const Both& both, const std::string& what, double overshoot = kDrives) {
  const auto& [m, p] = both;
  std::printf(
      "%-34s rise %6.1f ms, predicted %6.1f; overshoot %5.2f %%, predicted %5.2f; rms error %5.2f mm/s, "
      "predicted %5.2f\n",
      what.c_str(), 1e3 * m.rise_s, 1e3 * p.rise_s, 100 * m.overshoot, 100 * p.overshoot,
      1e3 * m.rms_error_mps, 1e3 * p.rms_error_mps);
  EXPECT_NEAR(m.rise_s, p.rise_s, 0.05 * p.rise_s + 0.003);
  EXPECT_NEAR(m.overshoot, p.overshoot, overshoot);
  EXPECT_NEAR(m.rms_error_mps, p.rms_error_mps, 0.15 * p.rms_error_mps + 0.001);
}

TEST(StepResponse, OfTheFirmwareIsWhatTheModelPredicts) {
  const double jump_mps2 = 50;  // the acceleration limit as good as away
  expect_alike(step(false, {}, 0.3), "ground, as it comes");
  expect_alike(step(true, {}, 0.3), "stand, as it comes");
  expect_alike(step(false, {{"acceleration_limit", jump_mps2}}, 0.2), "ground, as it comes, jump", kBrakes);
  expect_alike(step(false, {{"acceleration_limit", jump_mps2}, {"kA_left", 0.0}, {"kA_right", 0.0}}, 0.2),
               "ground, no kA, jump", kBrakes);
}

TEST(StepResponse, OfDesignedGainsIsWhatTheModelPredicts) {
  for (const bool on_stand : {false, true}) {
    const MotorModel motor = from_data_sheet(1, on_stand);
    for (const double part : {0.3, 0.6, 0.95}) {
      support::Desk desk(quiet_robot(on_stand));
      const RobotFacts facts = facts_on(desk);
      motor::DesignTask task{motor, facts.observer_radps, facts.count_m[0]};
      task.bandwidth_radps = part * design_gains(task).largest_bandwidth_radps;
      const auto design = design_gains(task);
      std::map<std::string, robot::Value> values{{"kp", design.kp}, {"ki", design.ki}};
      for (const char* side : {"left", "right"}) {
        values[std::string("kS_") + side] = motor.kS;
        values[std::string("kV_") + side] = motor.kV;
        values[std::string("kA_") + side] = motor.kA;
      }
      const std::string what = std::string(on_stand ? "stand" : "ground") + ", designed for " +
                               std::to_string(design.margins.bandwidth_radps / 6.2832).substr(0, 4) + " Hz";
      expect_alike(step(on_stand, values, 0.3), what);
      values["acceleration_limit"] = 50.0;
      expect_alike(step(on_stand, values, 0.2), what + ", jump", kBrakes);
      values["kV_left"] = values["kV_right"] = 0.0;  // the loop alone
      values["kS_left"] = values["kS_right"] = 0.0;
      values["kA_left"] = values["kA_right"] = 0.0;
      expect_alike(step(on_stand, values, 0.2), what + ", jump, loop alone");
    }
  }
}

TEST(StepResponse, TheRobotComesBackAndStands) {
  support::Desk desk(quiet_robot(false));
  {
    Bench bench(desk.client, facts_on(desk));
    robot::DriveSession session(desk.client);
    measure_step(bench, session, 0.2, 1.0);
  }
  EXPECT_NEAR(desk.robot->board().truth().x_m, 0, 0.02);
  EXPECT_EQ(desk.client.request(protocol::GetStatus{}).mode, protocol::Mode::disarmed);
}

}  // namespace
}  // namespace astro::motor
