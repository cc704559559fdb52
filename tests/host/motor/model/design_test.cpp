#include "host/motor/model/design.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "host/base/error.hpp"
#include "host/motor/model/prediction.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::motor {
namespace {

using support::Tells;
using testing::_;
constexpr double kPi = std::numbers::pi;
constexpr double kHz = 2 * kPi, kDegree = kPi / 180;
const MotorModel kGround{0.48, 12.2, 1.08};

DesignTask task(double bandwidth_Hz, double observer_radps = 100) {
  return {kGround, observer_radps, 8.07e-5, bandwidth_Hz * kHz};
}

Remark told(const DesignTask& wanted) {
  return support::told_by([&] { design_gains(wanted); });
}

TEST(Design, MeetsTheBandwidthAndLeavesSixtyDegrees) {
  for (const double observer_radps : {60.0, 100.0, 200.0, 400.0}) {
    for (const double part : {0.1, 0.3, 0.6, 0.99}) {
      DesignTask wanted = task(0, observer_radps);
      wanted.bandwidth_radps = part * design_gains(wanted).largest_bandwidth_radps;
      const Design design = design_gains(wanted);
      std::printf(
          "observer %3.0f rad/s, %5.2f Hz: kp %6.1f, ki %7.1f, crossover %5.1f rad/s, phase %.1f deg, "
          "gain x %.1f, sensitivity %.2f, noise %.3f V\n",
          observer_radps, wanted.bandwidth_radps / kHz, design.kp, design.ki, design.margins.crossover_radps,
          design.margins.phase_margin_rad / kDegree, design.margins.gain_margin, design.margins.sensitivity,
          design.noise_V);
      EXPECT_NEAR(design.margins.bandwidth_radps, wanted.bandwidth_radps, 0.02 * wanted.bandwidth_radps);
      EXPECT_GE(design.margins.phase_margin_rad, 59.5 * kDegree);
      EXPECT_GT(design.margins.gain_margin, 2.0);
      EXPECT_LT(design.margins.sensitivity, 1.7);
      EXPECT_GT(design.kp, 0);
      EXPECT_GT(design.ki, 0);
    }
  }
}

TEST(Design, AFasterObserverCarriesMoreUntilItLetsTheEncoderThrough) {
  const auto largest = [](double observer_radps, double count_m) {
    DesignTask wanted = task(0, observer_radps);
    wanted.count_m = count_m;
    return design_gains(wanted).largest_bandwidth_radps / kHz;
  };
  double before = 0;
  for (const double observer_radps : {50.0, 100.0, 200.0, 400.0}) {
    std::printf("observer %3.0f rad/s carries %.1f Hz, with a quarter of the counts %.1f Hz\n",
                observer_radps, largest(observer_radps, 8.07e-5), largest(observer_radps, 3.2e-4));
    EXPECT_GT(largest(observer_radps, 1e-6), before);
    before = largest(observer_radps, 1e-6);
  }
  EXPECT_LT(largest(400, 8.07e-5), largest(200, 8.07e-5)) << "noise is the limit there";
}

TEST(Design, WhoNamesNoBandwidthGetsTheStiffestLoop) {
  const Design chosen = design_gains(task(0));
  std::printf("chosen: %.1f Hz, kp %.1f, ki %.0f\n", chosen.margins.bandwidth_radps / kHz, chosen.kp,
              chosen.ki);
  for (const double part : {0.3, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0}) {
    DesignTask other = task(0);
    other.bandwidth_radps = part * chosen.largest_bandwidth_radps;
    EXPECT_GE(chosen.ki, 0.995 * design_gains(other).ki);
  }
}

TEST(Design, AHeavierRobotNeedsGainsInProportion) {
  DesignTask light = task(4), heavy = task(4);
  heavy.motor = {kGround.kS, 2 * kGround.kV, 2 * kGround.kA};
  EXPECT_NEAR(design_gains(heavy).kp, 2 * design_gains(light).kp, 0.01 * design_gains(heavy).kp);
  EXPECT_NEAR(design_gains(heavy).ki, 2 * design_gains(light).ki, 0.01 * design_gains(heavy).ki);
}

TEST(Design, RefusesWhatTheObserverCannotCarryAndSaysWhatCan) {
  const Remark refused = told(task(15));
  std::printf("%s\n", refused.sentence.c_str());
  ASSERT_THAT(refused, Tells(DesignProblem::observer_lags, "15", _, _));
  const double most_Hz = std::stod(refused.values[1]), observer_radps = std::stod(refused.values[2]);
  EXPECT_NO_THROW(design_gains(task(most_Hz))) << "what it offers is accepted";
  EXPECT_NO_THROW(design_gains(task(15, observer_radps)));
}

TEST(Design, RefusesWhatTheTickOrTheEncoderCannotCarry) {
  const Remark tick = told(task(300));
  std::printf("%s\n", tick.sentence.c_str());
  EXPECT_THAT(tick, Tells(DesignProblem::tick_lags, "300", _));
  DesignTask coarse = task(8, 200);
  coarse.count_m = 5e-3;
  const Remark encoder = told(coarse);
  std::printf("%s\n", encoder.sentence.c_str());
  EXPECT_THAT(encoder, Tells(DesignProblem::encoder_too_coarse));
  DesignTask none = task(3);
  none.motor.kA = 0;
  EXPECT_THAT(told(none), Tells(DesignProblem::no_motor_model));
}

// The frequency response is a closed form; the simulation knows nothing of it.
TEST(Margins, SayAtWhichGainTheSimulatedLoopBeginsToSwing) {
  const Design design = design_gains(task(5));
  const auto swings = [&](double factor) {
    WheelLoop loop{{0, kGround.kV, kGround.kA}, 0,   {},  factor * design.kp,
                   factor * design.ki,          100, 1e6, 1e-9};
    const std::vector<double> step(4000, 0.1);
    const auto course = predict(loop, step);
    double late = 0;
    for (std::size_t i = 3500; i < course.size(); ++i)
      late = std::max(late, std::abs(course[i].observed_mps - 0.1));
    return late > 0.05;
  };
  EXPECT_FALSE(swings(0.97 * design.margins.gain_margin));
  EXPECT_TRUE(swings(1.03 * design.margins.gain_margin));
}

TEST(Margins, TheNoiseOfAnEncoderIsWhatASimulatedWheelShows) {
  WheelLoop loop{{0, 12.2, 1.08}, 0, {0, 12.2, 1.08}, 0, 0, 100, 12, 8.07e-5};
  const std::vector<double> steady(20'000, 0.1234);
  const auto course = predict(loop, steady);
  double squares = 0;
  for (std::size_t i = 10'000; i < course.size(); ++i)
    squares += std::pow(course[i].observed_mps - course[i].true_mps, 2);
  const double seen = std::sqrt(squares / 10'000), said = quantisation_speed_mps(100, loop.count_m);
  std::printf("speed noise: %.3f mm/s simulated, %.3f mm/s computed\n", 1e3 * seen, 1e3 * said);
  EXPECT_LT(seen, 1.5 * said);
  EXPECT_GT(seen, 0.3 * said) << "an even motion's steps are not white: most are faster and filtered more";
}

}  // namespace
}  // namespace astro::motor
