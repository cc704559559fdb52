#include "host/calibration/judgement/cross_validation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "host/calibration/judgement/path_errors.hpp"
#include "host/calibration/judgement/student_t.hpp"
#include "host/calibration/likelihood/day_drift.hpp"
#include "host/simulation/study/setup.hpp"
#include "tests/host/calibration/ml_drives.hpp"
#include "tests/support/base/thorough.hpp"

// Verdicts and errors on robots whose factors change from one day to another, as judged by the days after.
namespace astro::calibration {
namespace {

using simulation::study::TrialSetup;

constexpr std::size_t kDays = 4;

/// Robots of the study, with what is driven on each day.
struct Robots {
  const char* name;
  TrialSetup setup;
};

std::vector<Robots> robots() {
  const auto with = [](auto change) {
    TrialSetup setup;
    // Slip decides how much factors are worth, and a slower tracker shows it as well.
    setup.count_rate_hz = 20;
    setup.truth_rate_hz = 10;
    change(setup);
    return setup;
  };
  return {{"ten squares", with([](TrialSetup&) {})},
          {"four squares", with([](TrialSetup& setup) { setup.runs = 2; })},
          {"less slip", with([](TrialSetup& setup) { setup.noise.K_m = 5e-7; })},
          {"squares, e = 0.015", with([](TrialSetup& setup) { setup.e = 0.015; })},
          {"squares and circles, e = 0.03", with([](TrialSetup& setup) {
             setup.e = 0.03;
             setup.circles = 2;
           })}};
}

/// Each day is off the mean of all days, so that two differ as DayDrift says.
WheelFactors on_a_day(const WheelFactors& mean, std::uint64_t seed) {
  const DayDrift drift;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0, std::sqrt(0.5));
  const double ratio = drift.E_d * normal(random), scale = 1 + drift.scale * normal(random),
               base = 1 + drift.b_over_scale * normal(random);
  WheelFactors day = mean;
  day.c_r *= scale * (1 + ratio / 2);
  day.c_l *= scale * (1 - ratio / 2);
  day.b_m *= scale * base;
  day.e += drift.e * normal(random);
  return day;
}

std::vector<Trajectory> drives_of_a_day(const TrialSetup& setup, const WheelFactors& right, std::size_t day,
                                        std::uint64_t seed) {
  simulation::study::DriveModel model;
  model.loaded = setup.loaded();
  model.actual = right;
  model.noise = setup.noise;
  model.count_rate_hz = setup.count_rate_hz;
  model.truth_rate_hz = setup.truth_rate_hz;
  std::vector<Trajectory> runs;
  for (int run = 0; run < setup.run_count(); ++run) {
    const Sense sense = simulation::study::sense_of(run);
    const auto course = setup.is_square(run) ? simulation::study::square_course(setup.side_m, sense)
                                             : simulation::study::circle_course(
                                                   setup.circle_radius_m, sense == Sense::ccw ? 12.6 : -12.6);
    runs.push_back(simulation::study::synthetic_drive(
        course, model, "day " + std::to_string(day) + " run " + std::to_string(run),
        simulation::study::derived_seed(seed, static_cast<std::uint64_t>(run))));
    runs.back().session = std::to_string(day);
    runs.back().started_s = 86400 * static_cast<double>(day);
  }
  return runs;
}

FactorVector vector_from(const WheelFactors& f) { return {f.c_r, f.c_l, f.b_m, f.e}; }

/// Days on average: how far factors end off on squares and a line on days to come, and whether they are no more off than days are.
struct OnOtherDays {
  double end_m = 0;
  bool right_on_a_day = false;
};

OnOtherDays on_other_days(const WheelFactors& factors, const WheelFactors& mean) {
  const FactorVector off = vector_from(factors) - vector_from(mean);
  const FactorCovariance of_a_day = DayDrift().covariance(mean) / 2;
  // e is left out: squares alone hardly show it, and their ends do not depend on it.
  const Eigen::Vector3d wheels = off.head<3>();
  const Eigen::Matrix3d covariance = of_a_day.topLeftCorner<3, 3>();
  return {std::sqrt(expected_end_error_m2(off * off.transpose() + of_a_day, mean)),
          wheels.dot(covariance.ldlt().solve(wheels)) < chi_square_95(3)};
}

/// Whether intervals of 1.96 standard errors contain the factors of another day: E_d, S, b / S and e.
struct Coverage {
  std::array<int, 4> inside{}, of{};

  void count(const MlEstimate& found, const WheelFactors& day) {
    const FactorVector off = vector_from(found.factors) - vector_from(day);
    const WheelFactors& f = found.factors;
    const double both = f.c_r + f.c_l;
    const FactorVector by[] = {{1 / f.c_r, -1 / f.c_l, 0, 0},
                               {1 / both, 1 / both, 0, 0},
                               {-1 / both, -1 / both, 1 / f.b_m, 0},
                               {0, 0, 0, 1}};
    for (std::size_t i = 0; i < 4; ++i) {
      ++of[i];
      inside[i] +=
          std::abs(by[i].dot(off)) < 1.96 * std::sqrt(by[i].dot(found.covariance_another_day * by[i]));
    }
  }
  void add(const Coverage& other) {
    for (std::size_t i = 0; i < 4; ++i) {
      inside[i] += other.inside[i];
      of[i] += other.of[i];
    }
  }
  double part(std::size_t i) const { return static_cast<double>(inside[i]) / of[i]; }
  std::string text() const {
    std::string list;
    for (const auto& [i, name] : {std::pair{0U, "E_d"}, {1U, "S"}, {2U, "b/S"}, {3U, "e"}})
      list +=
          std::string(i == 0 ? "" : ", ") + name + ' ' + std::to_string(100 * part(i)).substr(0, 5) + " %";
    return list;
  }
};

/// Verdicts on factors of one day against those in use, as other days turn out on average.
struct Verdicts {
  int better = 0, not_better = 0, not_judged = 0;
  int wrongly_better = 0;
  /// The factors found cut the end error by a fifth, and those in use are further off than what days differ by.
  int worth_it = 0, wrongly_not_better = 0;

  void count(Verdict verdict, const OnOtherDays& found, const OnOtherDays& in_use) {
    better += verdict == Verdict::better;
    wrongly_better += verdict == Verdict::better && found.end_m > in_use.end_m;
    const bool refused = verdict == Verdict::worse || verdict == Verdict::undecided;
    not_better += refused;
    not_judged += verdict == Verdict::unknown;
    const bool gains = found.end_m < 0.8 * in_use.end_m && !in_use.right_on_a_day;
    worth_it += gains;
    wrongly_not_better += gains && refused;
  }
  int pairs() const { return better + not_better + not_judged; }
  void add(const Verdicts& other) {
    better += other.better;
    not_better += other.not_better;
    not_judged += other.not_judged;
    wrongly_better += other.wrongly_better;
    worth_it += other.worth_it;
    wrongly_not_better += other.wrongly_not_better;
  }
  void print(const char* name) const {
    std::printf("  %-32s better %4d, %3d wrong; not better %4d; not judged %3d; worth it %4d, %3d refused\n",
                name, better, wrongly_better, not_better, not_judged, worth_it, wrongly_not_better);
  }
};

/// A part in a thousand off in E_d, S and b / S, with signs by chance.
WheelFactors slightly_off(const WheelFactors& right, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto off = [&] { return random() % 2 == 0 ? 1e-3 : -1e-3; };
  const double ratio = off(), scale = 1 + off();
  return {right.c_r * scale * (1 + ratio / 2), right.c_l * scale * (1 - ratio / 2),
          right.b_m * scale * (1 + off()), right.e};
}

TEST(Verdict, HoldsOnOtherDaysOfRobotsThatDrift) {
  const int trials = support::how_often(2, 40);
  Verdicts nominal, near, calibrated;
  Coverage one, two;
  std::uint64_t robots_so_far = 0;
  for (const Robots& robot : robots()) {
    Verdicts of_nominal, near_it, of_calibrated;
    Coverage of_one, of_two;
    for (int trial = 0; trial < trials; ++trial) {
      const std::uint64_t seed = simulation::study::derived_seed(++robots_so_far, 1);
      std::array<WheelFactors, kDays> right;
      std::vector<std::vector<Trajectory>> drives;
      std::vector<MlEstimate> found;
      MlOptions options;
      options.clock_known = true;
      for (std::size_t day = 0; day < kDays; ++day) {
        right[day] = on_a_day(robot.setup.actual(), simulation::study::derived_seed(seed, 1000 + day));
        drives.push_back(
            drives_of_a_day(robot.setup, right[day], day, simulation::study::derived_seed(seed, 100 + day)));
        found.push_back(estimate_ml(drives.back(), robot.setup.loaded(), options));
      }
      const WheelFactors mean = robot.setup.actual();
      for (std::size_t day = 0; day < kDays; ++day) {
        of_one.count(found[day], right[(day + 1) % kDays]);
        const auto judge = [&](const WheelFactors& in_use, Verdicts& verdicts) {
          verdicts.count(cross_validate(drives[day], in_use, found[day], options).verdict,
                         on_other_days(found[day].factors, mean), on_other_days(in_use, mean));
        };
        judge(robot.setup.loaded(), of_nominal);
        judge(slightly_off(mean, simulation::study::derived_seed(seed, 10 + day)), near_it);
        for (std::size_t other = 0; other < kDays; ++other)
          if (other != day) judge(found[other].factors, of_calibrated);
      }
      for (std::size_t day = 0; day < kDays; day += 2) {
        std::vector<Trajectory> both = drives[day];
        both.insert(both.end(), drives[day + 1].begin(), drives[day + 1].end());
        of_two.count(estimate_ml(both, robot.setup.loaded(), options), right[(day + 2) % kDays]);
      }
    }
    std::printf("%s\n", robot.name);
    of_nominal.print("in use: nominal");
    near_it.print("in use: a part in a thousand off");
    of_calibrated.print("in use: of another day");
    std::printf("  95 %% intervals on another day, of one day: %s\n", of_one.text().c_str());
    std::printf("  of two: %s\n", of_two.text().c_str());
    nominal.add(of_nominal);
    near.add(near_it);
    calibrated.add(of_calibrated);
    one.add(of_one);
    two.add(of_two);
  }
  std::printf("all, %d robots of each kind, %zu days each\n", trials, kDays);
  nominal.print("in use: nominal");
  near.print("in use: a part in a thousand off");
  calibrated.print("in use: of another day");
  std::printf("  95 %% intervals on another day, of one day: %s\n", one.text().c_str());
  std::printf("  of two: %s\n", two.text().c_str());
  EXPECT_LE(nominal.wrongly_better + near.wrongly_better + calibrated.wrongly_better,
            0.05 * (nominal.better + near.better + calibrated.better));
  // Factors of another day are as right as those found, and which of the two are nearer to a third day no drive of theirs tells.
  EXPECT_LE(nominal.wrongly_not_better + near.wrongly_not_better, 0.10 * (nominal.worth_it + near.worth_it));
  EXPECT_LE(calibrated.better, 0.06 * calibrated.pairs());
  for (const Coverage* coverage : {&one, &two})
    for (std::size_t i = 0; i < 3; ++i) {
      // Two standard deviations of chance; days of a robot are not independent, so it counts like half of them.
      const double chance = 2 * std::sqrt(0.95 * 0.05 / (coverage->of[i] / 2.0));
      EXPECT_GT(coverage->part(i), std::min(0.90, 0.95 - chance));
      EXPECT_LT(coverage->part(i), std::max(0.98, 0.95 + chance));
    }
}

}  // namespace
}  // namespace astro::calibration
