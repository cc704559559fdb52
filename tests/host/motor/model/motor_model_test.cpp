#include "host/motor/model/motor_model.hpp"

#include <gmock/gmock.h>

#include <cstdio>

#include "host/base/error.hpp"
#include "tests/host/motor/model/synthetic.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::motor {
namespace {

MotorFit fit(const SyntheticWheel& wheel) { return fit_motor(drive(wheel, 16, excitation_V), wheel.count_m); }

void expect_within(const MotorFit& fit, const MotorModel& truth, double part) {
  EXPECT_NEAR(fit.model.kS, truth.kS, part * truth.kS);
  EXPECT_NEAR(fit.model.kV, truth.kV, part * truth.kV);
  EXPECT_NEAR(fit.model.kA, truth.kA, part * truth.kA);
}

TEST(MotorFit, FindsTheModelBehindAQuantisedEncoder) {
  const SyntheticWheel wheel;
  const MotorFit found = fit(wheel);
  std::printf("kS %.5f of %.2f, kV %.4f of %.1f, kA %.4f of %.2f, residual %.4f V, %zu windows\n",
              found.model.kS, wheel.motor.kS, found.model.kV, wheel.motor.kV, found.model.kA, wheel.motor.kA,
              found.residual_V, found.windows.size());
  expect_within(found, wheel.motor, 0.005);
  EXPECT_GT(found.r_squared, 0.999);
}

TEST(MotorFit, TheStepsOfACoarseEncoderBendItByLittle) {
  for (const double count_m : {8.07e-5, 3.2e-4, 6.5e-4}) {
    SyntheticWheel wheel;
    wheel.count_m = count_m;
    const MotorFit found = fit(wheel);
    std::printf("a count of %.2f mm: kS %+.2f %%, kV %+.2f %%, kA %+.2f %%\n", 1e3 * count_m,
                100 * (found.model.kS / wheel.motor.kS - 1), 100 * (found.model.kV / wheel.motor.kV - 1),
                100 * (found.model.kA / wheel.motor.kA - 1));
    // Without instruments kA would be short by up to 16 %.
    expect_within(found, wheel.motor, count_m < 1e-4 ? 0.005 : 0.02);
  }
}

TEST(MotorFit, StandardErrorsSayHowFarOffItIs) {
  int inside = 0, all = 0;
  double worst = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SyntheticWheel wheel;
    wheel.noise_V = 0.3;
    wheel.seed = seed;
    const MotorFit found = fit(wheel);
    const auto judge = [&](double value, double truth, double error) {
      const double off = std::abs(value - truth) / error;
      worst = std::max(worst, off);
      inside += off < 2 ? 1 : 0;
      ++all;
      EXPECT_LT(off, 5) << "seed " << seed;
    };
    judge(found.model.kS, wheel.motor.kS, found.standard_error.kS);
    judge(found.model.kV, wheel.motor.kV, found.standard_error.kV);
    judge(found.model.kA, wheel.motor.kA, found.standard_error.kA);
  }
  std::printf("within two standard errors: %d of %d; the worst is off by %.1f\n", inside, all, worst);
  EXPECT_GE(inside, all * 80 / 100) << "95 % would be ideal; the errors are themselves estimated";
}

TEST(MotorFit, DoesNotDependOnHowOftenIsSampled) {
  for (const double period_s : {1e-3, 2e-3, 5e-3}) {
    SyntheticWheel wheel;
    wheel.period_s = period_s;
    SCOPED_TRACE(period_s);
    expect_within(fit(wheel), wheel.motor, 0.015);
  }
}

TEST(MotorFit, TakesALossOfSamplesForWhatItIs) {
  const SyntheticWheel wheel;
  std::vector<Sample> samples = drive(wheel, 16, excitation_V);
  samples.erase(samples.begin() + 1500, samples.begin() + 1900);
  samples.erase(samples.begin() + 10'050, samples.begin() + 10'080);
  expect_within(fit_motor(samples, wheel.count_m), wheel.motor, 0.005);
}

TEST(MotorFit, RefusesWhatHoldsNoModel) {
  const SyntheticWheel wheel;
  const auto refusal = [&](const std::vector<Sample>& samples) {
    return support::told_by([&] { fit_motor(samples, wheel.count_m); });
  };
  EXPECT_THAT(refusal({}), support::Tells(MotorProblem::turned_too_little));
  EXPECT_THAT(refusal(drive(wheel, 5, [](double) { return 0.9; })),
              support::Tells(MotorProblem::turned_too_little));
}

TEST(Breakaway, IsTheVoltageAtWhichTheWheelBeganToTurn) {
  for (const double sense : {1.0, -1.0}) {
    const auto rise = drive({}, 3, [=](double t) { return sense * t; });
    const auto found = breakaway_V(rise, SyntheticWheel{}.count_m);
    ASSERT_TRUE(found);
    std::printf("breakaway %.3f V of %.1f V\n", *found, sense);
    EXPECT_NEAR(*found, sense * 1.0, 0.03) << "a volt a second, and 20 ms until a count is seen";
  }
  EXPECT_FALSE(breakaway_V(drive({}, 0.9, [](double t) { return t; }), 8e-5));
}

}  // namespace
}  // namespace astro::motor
