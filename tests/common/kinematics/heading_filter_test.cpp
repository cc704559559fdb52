#include "common/kinematics/heading_filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "common/kinematics/slip_watch.hpp"
#include "tests/common/fixed/seeded.hpp"
#include "tests/common/kinematics/gyro_drive.hpp"
#include "tests/support/base/thorough.hpp"

namespace astro {
namespace {

using namespace tests;

HeadingFilter::Configuration configured() {
  const ParameterSet set = ParameterSet::defaults();
  return {set, make_geometry(set)};
}

HeadingFilter a_filter() {
  HeadingFilter filter;
  filter.configure(configured());
  return filter;
}

/// The same filter in double, as textbooks have it: two states with a whole covariance matrix, whose measurement is the increment of
/// the heading. Which innovations count is decided by the same rules, in radians and seconds.
class DoubleFilter {
 public:
  void advance(double gyro_rad, double wheels_rad, double path_m) {
    const double dt = 0.01, q_g = std::pow(0.025 * kDegree, 2) * dt;
    const bool rest = path_m == 0;
    still_ = rest ? still_ + 1 : 0;
    const double change = gyro_rad - before_;
    before_ = gyro_rad;
    scatter_ = still_ > 1 ? scatter_ + (change * change - scatter_) / 16 : 0;
    if (!knows_) {
      if (still_ <= 10) return window_.clear();
      window_.push_back(gyro_rad);
      if (window_.size() < 50) return;
      double sum = 0, squares = 0;
      for (const double each : window_) sum += each;
      for (const double each : window_) squares += std::pow(each - sum / 50, 2);
      window_.clear();
      if (squares / 50 > 4 * q_g) return;
      knows_ = true;
      bias_ = sum / 50 / dt;
      bb_ = q_g / 50 / dt / dt;
      return;
    }
    const double w = gyro_rad - bias_ * dt, r = wheels_rad - w;
    heading_ += w - wheels_rad;
    // F = [1 -dt; 0 1]; the increment's error is -dt e_b + n_g.
    hh_ += dt * dt * bb_ - 2 * dt * hb_ + q_g;
    hb_ -= dt * bb_;
    const double c_h = q_g - dt * hb_, c_b = -dt * bb_;
    const double q_w = std::max(5.29e-6 * path_m / (0.29 * 0.29), 1e-11), s = dt * dt * bb_ + q_g + q_w;
    const double count = GyroDrive::kCount_m / GyroDrive::kBase_m;
    const bool agrees = r * r <= 36 * (rest ? s : s + count * count * 2 / 3);
    if (agrees && (!rest || (still_ > 10 && scatter_ <= 8 * q_g))) {
      heading_ += c_h / s * r;
      bias_ += c_b / s * r;
      hh_ -= c_h * c_h / s;
      hb_ -= c_h * c_b / s;
      bb_ -= c_b * c_b / s;
    }
    bb_ += std::pow(0.001 * kDegree, 2) * dt;
  }
  double correction_rad() const { return heading_; }
  double bias_radps() const { return bias_; }

 private:
  std::vector<double> window_;
  double heading_ = 0, bias_ = 0, hh_ = 0, hb_ = 0, bb_ = 0, before_ = 0, scatter_ = 0;
  int still_ = 0;
  bool knows_ = false;
};

struct Errors {
  double wheels_deg = 0, fused_deg = 0, to_double_deg = 0;  // root mean square of all robots, at the end
};

Errors errors_of(const Course& course, int robots, double scale_sd) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  Errors sum;
  for (int k = 0; k < robots; ++k) {
    Gyro gyro;
    gyro.scale_error = scale_sd * normal(random);
    gyro.bias_radps *= normal(random);
    GyroDrive drive(gyro, random());
    HeadingFilter filter = a_filter();
    DoubleFilter same;
    for (const Motion& motion : course) {
      const HeadingStep step = drive.advance(motion);
      filter.advance(step, true);
      same.advance(static_cast<double>(step.gyro_48) / 65536 * kUnit_32, step.wheels_32 * kUnit_32,
                   step.path_20 * 0x1p-20);
    }
    const double wheels = drive.wheels_rad() - drive.true_rad();
    sum.wheels_deg += std::pow(wheels / kDegree, 2);
    sum.fused_deg += std::pow((wheels + correction_rad(filter)) / kDegree, 2);
    sum.to_double_deg += std::pow((correction_rad(filter) - same.correction_rad()) / kDegree, 2);
  }
  return {std::sqrt(sum.wheels_deg / robots), std::sqrt(sum.fused_deg / robots),
          std::sqrt(sum.to_double_deg / robots)};
}

TEST(HeadingFilter, TenSquaresEndWithLessThanHalfOfTheWheelsErrorWhateverTheArithmetic) {
  for (const bool both_ways : {false, true}) {
    const Errors got = errors_of(squares(10, both_ways), support::how_often(30, 120), 0.0005);
    std::printf("  ten squares%s: wheels %.2f, with the gyro %.2f degrees rms; %.4f from double\n",
                both_ways ? ", both ways" : "", got.wheels_deg, got.fused_deg, got.to_double_deg);
    // A root mean square of 120 robots is known to 6 %, of 30 to 13 %: within 2 sigma of the budget's 4.6, the drive is the budget's.
    EXPECT_NEAR(got.wheels_deg, 4.6, 1.1);
    EXPECT_LE(got.fused_deg, 2.2);
    EXPECT_LE(got.to_double_deg, 0.01);
  }
}

struct Kick {
  double degrees = 0;
  int steps = 0;
  bool standing = false;
};

/// The heading error of robots that are kicked in the first stand or on the first line of two squares; root mean square, degrees. The
/// same robots with the same noise for every kick.
double error_after_deg(const Kick& kick, int robots) {
  const Course course = squares(2, true);
  std::mt19937_64 random(7);
  double sum = 0;
  for (int k = 0; k < robots; ++k) {
    GyroDrive drive({}, random());
    const std::uint64_t later = random();
    const std::size_t begin = kick.standing ? 150 + later % 150 : 550 + later % 700;
    const std::size_t end = begin + static_cast<std::size_t>(kick.steps);
    HeadingFilter filter = a_filter();
    SlipWatch watch;
    watch.configure(configured());
    for (std::size_t i = 0; i < course.size(); ++i) {
      const HeadingStep step =
          drive.advance(course[i], i >= begin && i < end ? kick.degrees * kDegree / kick.steps : 0);
      filter.advance(step, !watch.slipping());
      watch.advance(step, filter);
    }
    sum += std::pow((drive.wheels_rad() + correction_rad(filter) - drive.true_rad()) / kDegree, 2);
  }
  return std::sqrt(sum / robots);
}

TEST(HeadingFilter, AKickThatNoWheelSeesLeavesATenthOfADegreeAtMostDrivingAndStanding) {
  const int robots = support::how_often(30, 120);
  for (const bool standing : {false, true}) {
    const double without_deg = error_after_deg({0, 0, standing}, robots);
    for (const double degrees : {5.0, 20.0}) {
      for (const int steps : {20, 150}) {
        const double with_deg = error_after_deg({degrees, steps, standing}, robots);
        std::printf("  kick of %2.0f degrees in %.2f s, %s: %.3f degrees rms, %.3f without\n", degrees,
                    steps / 100.0, standing ? "standing" : "driving", with_deg, without_deg);
        EXPECT_LE(with_deg, without_deg + 0.1);
      }
    }
  }
}

TEST(HeadingFilter, SaysNothingBeforeAQuietStandHasShownTheBias) {
  GyroDrive drive({}, 1);
  HeadingFilter filter = a_filter();
  for (int i = 0; i < 1000; ++i) filter.advance(drive.advance({0.3, 0.5}), true);
  EXPECT_FALSE(filter.knows_bias());
  EXPECT_EQ(filter.correction_48(), 0);
  // Somebody handles the robot: 3 degrees a second to and fro, which its wheels do not see.
  for (int i = 0; i < 1000; ++i) filter.advance(drive.advance({}, 0.03 * kDegree * std::sin(0.3 * i)), true);
  EXPECT_FALSE(filter.knows_bias());
  for (int i = 0; i < 70; ++i) filter.advance(drive.advance({}), true);
  EXPECT_TRUE(filter.knows_bias());
  // A mean of half a second is good to 0.035 degrees a second: four of them, and the rounding of the gyro.
  EXPECT_NEAR(static_cast<double>(filter.bias_48()) / 65536 * kUnit_32 * 100, drive.bias_radps(),
              0.15 * kDegree);
}

TEST(HeadingFilter, ABiasThatHasMovedIsFoundAnewWithinSixSecondsAtRest) {
  GyroDrive cold({}, 1);
  HeadingFilter filter = a_filter();
  for (int i = 0; i < 500; ++i) filter.advance(cold.advance({}), true);
  GyroDrive warm({.bias_radps = 5 * kDegree}, 2);
  for (int i = 0; i < 600; ++i) filter.advance(warm.advance({}), true);
  ASSERT_TRUE(filter.knows_bias());
  const double before = correction_rad(filter);
  for (int i = 0; i < 1000; ++i) filter.advance(warm.advance({}), true);
  // The noise of ten seconds is 0.08 degrees if nothing is learned from the wheels, which stand.
  EXPECT_NEAR(correction_rad(filter), before, 0.3 * kDegree);
}

TEST(HeadingFilter, ATurnTableIsNoBias) {
  HeadingFilter filter = a_filter();
  GyroDrive turned({.bias_radps = 11 * kDegree}, 1);
  for (int i = 0; i < 1000; ++i) filter.advance(turned.advance({}), true);
  EXPECT_FALSE(filter.knows_bias());
  GyroDrive stands({.bias_radps = 9 * kDegree}, 1);
  for (int i = 0; i < 200; ++i) filter.advance(stands.advance({}), true);
  EXPECT_TRUE(filter.knows_bias());
  int steps = 0;
  while (filter.knows_bias() && ++steps < 1000) filter.advance(turned.advance({}), true);
  EXPECT_FALSE(filter.knows_bias());
  EXPECT_EQ(filter.innovation_48(), 0);
}

TEST(HeadingFilter, AHeadingWithoutGyroGoesOnAsTheWheelsDo) {
  GyroDrive drive({}, 1);
  HeadingFilter filter = a_filter();
  for (const Motion& motion : squares(1, false)) filter.advance(drive.advance(motion), true);
  const std::int64_t correction = filter.correction_48(), bias = filter.bias_48();
  for (int i = 0; i < 1000; ++i) filter.skip();
  EXPECT_EQ(filter.correction_48(), correction);
  EXPECT_EQ(filter.bias_48(), bias);
}

// What it promises shows under the sanitizers, which find an overflow.
TEST(HeadingFilter, NoNumberOverflowsWhateverTheRobotAndItsGyroDo) {
  Seeded random(11);
  int valid = 0;
  for (int robot = 0; robot < 200; ++robot) {
    ParameterSet set = ParameterSet::defaults();
    const auto pick = [&](Param param) {
      const ParamRow& row = param_row(param);
      set.set(param, random.between32(row.minimum_raw, row.maximum_raw));
    };
    pick(Param::b);
    pick(Param::wheel_diameter);
    pick(Param::counts_per_motor_rev);
    if (!validate(set)) continue;
    ++valid;
    const HeadingFilter::Configuration configuration(set, make_geometry(set));
    HeadingFilter filter;
    filter.configure(configuration);
    SlipWatch watch;
    watch.configure(configuration);
    for (int i = 0; i < 3000; ++i) {
      HeadingStep step;
      if (i > 100) {
        step.gyro_48 = random.any_size(46);
        step.wheels_32 = static_cast<std::int32_t>(random.any_size(31));
        step.path_20 =
            i % 200 < 100 ? 0 : static_cast<std::uint32_t>(random.bits() >> (32 + random.bits() % 32));
      }
      filter.advance(step, i % 7 != 0);
      watch.advance(step, filter);
      ASSERT_GE(filter.bias_variance(), 0) << i;
    }
  }
  EXPECT_GT(valid, 20);
}

}  // namespace
}  // namespace astro
