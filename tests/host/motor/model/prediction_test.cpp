#include "host/motor/model/prediction.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace astro::motor {
namespace {

const MotorModel kMotor{0.48, 12.2, 1.08};

TEST(Prediction, WithoutGainsItIsTheMotorsOwnStep) {
  // The feed-forward of kV alone on a wheel without friction: an exponential towards the set point.
  const WheelLoop loop{{0, 12.2, 1.08}, 0, {0, 12.2, 0}, 0, 0, 100, 12, 1e-9};
  const std::vector<double> step(1000, 0.2);
  const auto course = predict(loop, step);
  const double tau_s = kMotor.time_constant_s();
  for (const std::size_t ms : {50U, 100U, 200U, 500U})
    EXPECT_NEAR(course[ms].true_mps, 0.2 * (1 - std::exp(-1e-3 * static_cast<double>(ms) / tau_s)), 1e-5);
  // A ramp would be followed 2 / w late; the tail of an exponential by its own slope.
  EXPECT_NEAR(course[900].observed_mps, 0.2, 1e-3);
}

TEST(Prediction, FrictionHoldsUntilTheVoltageBreaksItAndTheIntegralGetsThere) {
  const WheelLoop loop{kMotor, 1.0, {}, 0, 100, 100, 12, 8e-5};
  const std::vector<double> step(3000, 0.05);
  const auto course = predict(loop, step);
  std::size_t moves = 0;
  while (moves < course.size() && course[moves].true_mps == 0) ++moves;
  EXPECT_NEAR(static_cast<double>(moves), 1.0 / (100 * 0.05) * 1000, 15)
      << "ki e t reaches the breakaway voltage; for 2 / w the observer believes that the wheel jumped too";
  EXPECT_NEAR(course.back().true_mps, 0.05, 0.02);
}

TEST(Prediction, TheLimitHoldsAndTheIntegralDoesNotWindUp) {
  const WheelLoop loop{kMotor, 1.0, kMotor, 40, 1200, 100, 3, 8e-5};
  std::vector<double> step(2000, 1.0);  // would need 12.7 V
  step.resize(3000, 0.1);
  const auto course = predict(loop, step);
  for (const Predicted& at : course) ASSERT_LE(std::abs(at.voltage_V), 3);
  // The set points shrink until they can be reached, so the voltage is at the limit now and then.
  EXPECT_NEAR(course[1999].voltage_V, 3, 0.1);
  EXPECT_NEAR(course[1999].true_mps, (3 - kMotor.kS) / kMotor.kV, 5e-3);
  EXPECT_NEAR(course.back().true_mps, 0.1, 0.005);
  EXPECT_LT(course[2400].true_mps, 0.12) << "at once, not after the integral has run down";
}

TEST(Prediction, BothWaysAreAlike) {
  const WheelLoop loop{kMotor, 1.0, kMotor, 20, 300, 100, 12, 8e-5};
  const std::vector<double> forward(500, 0.2), backward(500, -0.2);
  const auto there = predict(loop, forward), back = predict(loop, backward);
  for (std::size_t i = 0; i < there.size(); ++i)
    EXPECT_NEAR(there[i].true_mps, -back[i].true_mps, 1e-3);  // a count is floored, not rounded to zero
}

TEST(StepFigures, OfAnExponentialAreThoseOfTheBook) {
  std::vector<double> time, goal, speed;
  for (int i = 0; i < 2000; ++i) {
    time.push_back(1e-3 * i);
    goal.push_back(0.5);
    speed.push_back(0.5 * (1 - std::exp(-1e-3 * i / 0.1)));
  }
  const StepFigures figures = step_figures(time, goal, speed);
  EXPECT_NEAR(figures.rise_s, 0.1 * std::log(9.0), 1e-4);
  EXPECT_EQ(figures.overshoot, 0);
  EXPECT_NEAR(figures.worst_error_mps, 0.5, 1e-9);
  for (double& v : speed) v *= 1.25;
  EXPECT_NEAR(step_figures(time, goal, speed).overshoot, 0.25, 1e-6);
  for (double& v : speed) v = -v;
  for (double& g : goal) g = -g;
  EXPECT_NEAR(step_figures(time, goal, speed).overshoot, 0.25, 1e-6) << "backward alike";
}

TEST(StepFigures, ASpeedThatNeverGetsThereHasNoRise) {
  const std::vector<double> time{0, 1, 2}, goal{1, 1, 1}, speed{0, 0.5, 0.6};
  EXPECT_TRUE(std::isnan(step_figures(time, goal, speed).rise_s));
}

}  // namespace
}  // namespace astro::motor
