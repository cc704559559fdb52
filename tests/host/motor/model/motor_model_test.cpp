#include "host/motor/model/motor_model.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <vector>

#include "host/base/error.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::motor {

namespace {

/// A wheel that obeys the model exactly, seen through an encoder.
struct SyntheticWheel {
  MotorModel motor{0.48, 12.2, 1.08};
  double breakaway_V = 1.0;
  double count_m = 8.07e-5;
  double noise_V = 0;      // white per 10 ms: torque ripple
  double period_s = 1e-3;  // of the samples
  unsigned seed = 1;
};

std::vector<Sample> drive(const SyntheticWheel& wheel, double seconds,
                          const std::function<double(double)>& voltage_V) {
  std::mt19937 random(wheel.seed);
  std::normal_distribution<double> ripple(0, wheel.noise_V > 0 ? wheel.noise_V : 1);
  std::uniform_real_distribution<double> anywhere(0, 1);
  constexpr double kStep_s = 1e-4;
  const double start = anywhere(random);
  double speed = 0, position = 0, disturbance = 0;
  std::vector<Sample> samples;
  const int steps = static_cast<int>(std::lround(seconds / kStep_s));
  const int per_sample = static_cast<int>(std::lround(wheel.period_s / kStep_s));
  double held_V = 0;
  for (int i = 0; i < steps; ++i) {
    const double t = i * kStep_s;
    if (i % per_sample == 0) {
      held_V = voltage_V(t);
      samples.push_back({t, held_V, std::floor(position / wheel.count_m + start) * wheel.count_m});
    }
    if (i % 100 == 0) disturbance = wheel.noise_V > 0 ? ripple(random) : 0;
    const double V = held_V + disturbance;
    if (speed == 0 && std::abs(V) <= wheel.breakaway_V) continue;
    const double sense = speed != 0 ? speed : V;
    const double change =
        (V - std::copysign(wheel.motor.kS, sense) - wheel.motor.kV * speed) / wheel.motor.kA * kStep_s;
    const double next = (speed + change) * sense < 0 ? 0 : speed + change;
    position += (speed + next) / 2 * kStep_s;
    speed = next;
  }
  return samples;
}

/// Up and down slowly, both ways, and four steps: 16 s.
double excitation_V(double t) {
  const auto triangle = [](double at) { return at < 2.5 ? 1.6 * at : 1.6 * (5 - at); };
  if (t < 5) return triangle(t);
  if (t < 10) return -triangle(t - 5);
  const double phase = std::fmod(t - 10, 1.5);
  if (phase > 0.7) return 0;
  return (static_cast<int>((t - 10) / 1.5) % 2 == 0 ? 1 : -1) * (t < 13 ? 4.0 : 2.5);
}

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
