#include "host/calibration/preparation/sessions.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <numbers>
#include <utility>

#include "host/calibration/likelihood/maximum_likelihood.hpp"
#include "host/calibration/preparation/mounting.hpp"
#include "tests/host/calibration/ml_drives.hpp"

namespace astro::calibration {
namespace {

using simulation::study::DriveModel;

/// The same robot on another day: the tracked body 5 degrees and 30 mm from where it was.
DriveModel on_another_day(DriveModel model) {
  model.lever.x_m += 0.024;
  model.lever.y_m -= 0.018;
  model.lever.theta_rad += 5 * std::numbers::pi / 180;
  return model;
}

void append(std::vector<Trajectory>& runs, std::vector<Trajectory> more) {
  for (Trajectory& run : more) runs.push_back(std::move(run));
}

std::vector<int> sessions_of(const std::vector<Trajectory>& runs, const WheelFactors& loaded,
                             bool clock_known = true) {
  std::vector<int> sessions;
  for (const PreparedRun& run : prepare(runs, loaded, clock_known, Density::independent).runs)
    sessions.push_back(run.session);
  return sessions;
}

TEST(Mounting, IsWhereTheBodySits) {
  const DriveModel model = astro_drive();
  const std::vector<Trajectory> runs = squares(model, 2);
  const PreparedRuns prepared = prepare(runs, model.loaded, true, Density::independent);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto pieces = pieces_of(prepared.runs[i], prepared.clocks[i], model.loaded.b_m);
    const auto rates = fit_headings(pieces);
    ASSERT_TRUE(rates);
    const auto found = mounting_of(pieces, *rates);
    ASSERT_TRUE(found);
    // Beyond four standard errors a normal error lies once in 16,000; the scale is off by half a percent.
    EXPECT_NEAR(found->lever.x_m, model.lever.x_m, 4 * std::sqrt(found->covariance(0, 0)) + 5e-4);
    EXPECT_NEAR(found->lever.y_m, model.lever.y_m, 4 * std::sqrt(found->covariance(1, 1)) + 5e-4);
    EXPECT_NEAR(found->lever.theta_rad, model.lever.theta_rad, 4 * std::sqrt(found->covariance(2, 2)));
  }
}

TEST(Mounting, OfALineLeavesOpenWhereTheBodySitsAlongIt) {
  const DriveModel model = astro_drive();
  const std::vector<Trajectory> square = squares(model, 1);
  const std::vector<Trajectory> line{
      simulation::study::synthetic_drive(simulation::study::line_course(5), model, "line", kSeed)};
  const auto pieces_of_first = [&](const std::vector<Trajectory>& runs) {
    const PreparedRuns prepared = prepare(runs, model.loaded, true, Density::independent);
    return pieces_of(prepared.runs[0], prepared.clocks[0], model.loaded.b_m);
  };
  const auto found = mounting_of(pieces_of_first(line), *fit_headings(pieces_of_first(square)));
  ASSERT_TRUE(found);
  EXPECT_GT(std::sqrt(found->covariance(0, 0)), 0.05);  // metres
  EXPECT_NEAR(found->lever.theta_rad, model.lever.theta_rad, 4 * std::sqrt(found->covariance(2, 2)));
}

TEST(Sessions, AreOneWhereNobodyMovedTheBody) {
  const DriveModel model = astro_drive();
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    EXPECT_EQ(sessions_of(squares(model, 4, 2, seed), model.loaded), (std::vector{0, 0, 0, 0})) << seed;
}

TEST(Sessions, AreToldApartByWhereTheBodySits) {
  const DriveModel model = astro_drive(), later = on_another_day(model);
  std::vector<Trajectory> runs = squares(model, 2);
  append(runs, squares(later, 2));
  append(runs, squares(model, 1, 3, kSeed + 9));  // it was put back
  EXPECT_EQ(sessions_of(runs, model.loaded), (std::vector{0, 0, 1, 1, 0}));
}

TEST(Sessions, AreToldApartByTheirClocks) {
  DriveModel model = astro_drive();
  std::vector<Trajectory> runs = squares(model, 2);
  model.clock_skew = -0.023;
  append(runs, squares(model, 2));
  EXPECT_EQ(sessions_of(runs, model.loaded, false), (std::vector{0, 0, 1, 1}));
}

/// The same drive so much later, by both clocks.
Trajectory later_by(double seconds, Trajectory run) {
  for (WheelSample& sample : run.wheels) sample.time_s += seconds;
  for (BodySample& sample : run.truth) sample.time_s += seconds;
  return run;
}

TEST(Sessions, TakeARunThatShowsNothingForOneOfTheDriveNearestInTime) {
  const DriveModel model = astro_drive(), later = on_another_day(model);
  DriveModel blind = later;
  blind.headings = false;
  const Trajectory first = squares(model, 1)[0], second = later_by(86400, squares(later, 1)[0]);
  const Trajectory line = later_by(86400 + 600, simulation::study::synthetic_drive(
                                                    simulation::study::line_course(5), blind, "line", kSeed));
  EXPECT_EQ(sessions_of({first, second, line}, model.loaded), (std::vector{0, 1, 1}));
  EXPECT_EQ(sessions_of({second, first, line}, model.loaded), (std::vector{0, 1, 0}));
  EXPECT_EQ(sessions_of({line, first, second}, model.loaded), (std::vector{0, 1, 0}));
}

TEST(Sessions, AreTheSameInEveryOrder) {
  const DriveModel model = astro_drive(), later = on_another_day(model);
  std::vector<Trajectory> runs = squares(model, 2);
  append(runs, squares(later, 2));
  for (const DriveModel& day : {model, later})
    runs.push_back(simulation::study::synthetic_drive(simulation::study::line_course(3), day, "line", kSeed));
  EXPECT_EQ(sessions_of(runs, model.loaded), (std::vector{0, 0, 1, 1, 0, 1}));
  std::rotate(runs.begin(), runs.begin() + 4, runs.end());
  EXPECT_EQ(sessions_of(runs, model.loaded), (std::vector{0, 1, 0, 0, 1, 1}));
}

TEST(Sessions, AreThoseThatWereNamed) {
  const DriveModel model = astro_drive();
  std::vector<Trajectory> runs = squares(model, 4);
  runs[0].session = runs[2].session = "monday";
  runs[1].session = runs[3].session = "tuesday";
  EXPECT_EQ(sessions_of(runs, model.loaded), (std::vector{0, 1, 0, 1}));
}

/// The mean of two values, each with the weight of its error.
double weighted(double a, double se_a, double b, double se_b) {
  const double wa = 1 / (se_a * se_a), wb = 1 / (se_b * se_b);
  return (wa * a + wb * b) / (wa + wb);
}

TEST(Sessions, OfOneRobotPoolToTheWeightedMeanOfTheirFactors) {
  const DriveModel model = astro_drive(), later = on_another_day(model);
  const std::vector<Trajectory> first = squares(model, 6), second = squares(later, 6, 3, kSeed + 1);
  std::vector<Trajectory> all = first;
  append(all, second);
  const auto begin = std::chrono::steady_clock::now();
  const MlEstimate pooled = estimate_ml(all, model.loaded);
  const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const MlEstimate a = estimate_ml(first, model.loaded), b = estimate_ml(second, model.loaded);
  const auto apart = [&](double WheelFactors::*factor, double MlErrors::*se) {
    return std::abs(pooled.factors.*factor -
                    weighted(a.factors.*factor, a.se.*se, b.factors.*factor, b.se.*se)) /
           (pooled.se.*se);
  };
  std::printf("pooled in %.2f s: c_R %.2f, c_L %.2f, b %.2f standard errors from the weighted mean\n", took_s,
              apart(&WheelFactors::c_r, &MlErrors::c_r), apart(&WheelFactors::c_l, &MlErrors::c_l),
              apart(&WheelFactors::b_m, &MlErrors::b_m));
  EXPECT_LT(apart(&WheelFactors::c_r, &MlErrors::c_r), 1);
  EXPECT_LT(apart(&WheelFactors::c_l, &MlErrors::c_l), 1);
  EXPECT_LT(apart(&WheelFactors::b_m, &MlErrors::b_m), 1);
  EXPECT_LT(pooled.dispersion, 1.2);
  ASSERT_EQ(pooled.sessions.size(), 2U);
  EXPECT_NEAR(pooled.sessions[1].lever.theta_rad - pooled.sessions[0].lever.theta_rad,
              later.lever.theta_rad - model.lever.theta_rad, 2e-3);
  EXPECT_NEAR(pooled.sessions[1].lever.x_m - pooled.sessions[0].lever.x_m, 0.024, 1e-3);
}

/// What the fit of these drives says of their sessions.
std::vector<int> fitted_sessions(const MlEstimate& estimate) {
  std::vector<int> sessions;
  for (const RunFit& run : estimate.runs) sessions.push_back(run.session);
  return sessions;
}

std::vector<Trajectory> circles(const DriveModel& model, int count, std::uint64_t seed) {
  std::vector<Trajectory> runs;
  for (int i = 0; i < count; ++i)
    runs.push_back(simulation::study::synthetic_drive(
        simulation::study::circle_course(1, (i % 2 == 0 ? 4 : -4) * std::numbers::pi), model,
        "circle " + std::to_string(i + 1), seed + static_cast<std::uint64_t>(i)));
  return runs;
}

/// The factors as they come out if nobody had moved the body: neither further off nor less certain. A quarter of the errors is
/// what the places of two sessions cost in place of one.
void expect_unharmed(const MlEstimate& moved, const MlEstimate& unmoved, const char* what) {
  EXPECT_LT(moved.se.c_r, 1.25 * unmoved.se.c_r) << what;
  EXPECT_LT(moved.se.b_m, 1.25 * unmoved.se.b_m) << what;
  EXPECT_NEAR(moved.factors.c_r, unmoved.factors.c_r, unmoved.se.c_r) << what;
  EXPECT_NEAR(moved.factors.b_m, unmoved.factors.b_m, unmoved.se.b_m) << what;
}

TEST(Sessions, AreFoundFromTheFitOfAllDrivesWhereNoDriveAloneShowsWhereTheBodySits) {
  DriveModel day = astro_drive(), later = on_another_day(day);
  const auto both = [&](auto drives, auto more) {
    std::vector<Trajectory> runs = drives(day, kSeed);
    append(runs, more(later, kSeed + 50));
    std::vector<Trajectory> unmoved = drives(day, kSeed);
    append(unmoved, more(day, kSeed + 50));
    return std::pair{estimate_ml(runs, day.loaded), estimate_ml(unmoved, day.loaded)};
  };
  const auto four_circles = [](const DriveModel& model, std::uint64_t seed) {
    return circles(model, 4, seed);
  };
  const auto three_squares = [](const DriveModel& model, std::uint64_t seed) {
    return squares(model, 3, 3, seed);
  };
  for (const bool headings : {true, false}) {
    day.headings = later.headings = headings;
    const auto [squares_moved, squares_unmoved] = both(three_squares, three_squares);
    EXPECT_EQ(fitted_sessions(squares_moved), (std::vector{0, 0, 0, 1, 1, 1})) << headings;
    expect_unharmed(squares_moved, squares_unmoved, "squares");
    const auto [mixed, mixed_unmoved] = both(three_squares, four_circles);
    EXPECT_EQ(fitted_sessions(mixed), (std::vector{0, 0, 0, 1, 1, 1, 1})) << headings;
    expect_unharmed(mixed, mixed_unmoved, "squares and circles");
  }
  day.headings = later.headings = true;
  const auto [moved, unmoved] = both(four_circles, four_circles);
  EXPECT_EQ(fitted_sessions(moved), (std::vector{0, 0, 0, 0, 1, 1, 1, 1}));
  expect_unharmed(moved, unmoved, "circles");
}

TEST(Sessions, AreFoundWhereAFarPlaceOfTheBodyHidesTwoNearEachOther) {
  DriveModel model = astro_drive();
  model.noise.K_m = 2e-5;
  model.truth_rate_hz = 20;
  model.headings = false;
  std::vector<Trajectory> runs;
  std::uint64_t seed = kSeed;
  for (const LeverArm& place : {LeverArm{0.05, 0.03, 0.1}, {0.05, 0.045, 0.1}, {0.2, -0.1, 0.1}}) {
    model.lever = place;
    append(runs, squares(model, 4, 2, ++seed));
  }
  EXPECT_EQ(fitted_sessions(estimate_ml(runs, model.loaded)),
            (std::vector{0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2}));
}

TEST(Sessions, AreNotSplitByTheFitWhereNobodyMovedTheBody) {
  DriveModel model = astro_drive();
  for (const bool headings : {true, false})
    for (const double windup_rad : {0.0, 0.02}) {
      model.headings = headings;
      model.windup_rad = windup_rad;  // spins of real tyres shift where the body seems to sit
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        std::vector<Trajectory> runs = squares(model, 4, 2, seed);
        append(runs, circles(model, 2, 10 * seed));
        EXPECT_EQ(estimate_ml(runs, model.loaded).sessions.size(), 1U)
            << headings << ' ' << windup_rad << ' ' << seed;
      }
    }
}

// A circle leaves two unknowns of the mounting open, and how the robot starts shows little of them. Noise in the displacements once
// passed for knowledge of them, so that circles one way and circles the other way became two sessions.
TEST(Sessions, AreOneWhereNoisyCirclesBothWaysHardlyShowWhereTheBodySits) {
  using simulation::study::Leg;
  DriveModel model = astro_drive();
  model.loaded.b_m = 0.2;
  model.actual = {1.004, 0.998, 0.203};
  model.lever = {0.05, 0.03, 0.1};
  model.noise = {2e-5, 1e-3, 2e-3};
  model.truth_rate_hz = 100;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    std::vector<Trajectory> runs;
    for (int i = 0; i < 4; ++i) {
      const double way = i % 2 == 0 ? -1 : 1;
      const Leg rest{Leg::Kind::rest, 0, 0, 2}, spin{Leg::Kind::turn, 0, 0.1 * way, 0};
      runs.push_back(simulation::study::synthetic_drive(
          {rest, spin, {Leg::Kind::turn, 9, 24 * way, 0}, spin, rest}, model,
          "circle " + std::to_string(i + 1), 10 * seed + static_cast<std::uint64_t>(i)));
    }
    EXPECT_EQ(sessions_of(runs, model.loaded, false), (std::vector{0, 0, 0, 0})) << seed;
  }
}

}  // namespace
}  // namespace astro::calibration
