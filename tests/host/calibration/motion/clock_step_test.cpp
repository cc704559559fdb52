#include "host/calibration/motion/clock_step.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>

#include "host/calibration/motion/stamp_leap.hpp"
#include "tests/host/calibration/ml_drives.hpp"

namespace astro::calibration {
namespace {

namespace study = simulation::study;

constexpr double kWheelbase_m = 0.29;

/// Robots, trackers and courses that a study has, each of them with every other.
struct StudyDrive {
  std::string name;
  Trajectory run;
  bool is_sharp = true;  // the tracker shows speeds, and clocks run like quartz
};

std::vector<StudyDrive> study_drives() {
  const std::pair<const char*, study::Course> courses[] = {
      {"square of 1 m", study::square_course(1, Sense::cw)},
      {"square of 3 m", study::square_course(3, Sense::ccw)},
      {"line of 4 m", study::line_course(4)},
      {"four turns on the spot", study::spin_course(8 * std::numbers::pi)},
      {"two circles", study::circle_course(0.5, 4 * std::numbers::pi)},
  };
  struct Tracker {
    const char* name;
    double sigma_m, sigma_rad, rate_hz, count_rate_hz;
    bool headings, is_sharp;
  };
  const Tracker trackers[] = {
      {"cameras", 5e-4, 2.6e-3, 60, 100, true, true},     {"fast cameras", 3e-4, 1e-3, 240, 50, true, true},
      {"slow counts", 5e-4, 2.6e-3, 100, 10, true, true}, {"tags", 0.01, 0.02, 20, 50, true, false},
      {"positions", 1e-3, 0, 60, 100, false, true},       {"radio", 0.05, 0, 10, 50, false, false},
  };
  std::vector<StudyDrive> drives;
  std::uint64_t number = 0;
  for (const auto& [course_name, course] : courses)
    for (const Tracker& tracker : trackers)
      for (const double skew : {0.0, 3e-4, -4e-3}) {
        if (!tracker.headings && course_name == courses[3].first) continue;
        study::DriveModel model = astro_drive();
        model.noise = {2.6e-6, tracker.sigma_m, tracker.sigma_rad};
        model.truth_rate_hz = tracker.rate_hz;
        model.count_rate_hz = tracker.count_rate_hz;
        model.headings = tracker.headings;
        model.clock_skew = skew;
        model.clock_offset_s = 0.3;
        drives.push_back({fmt::format("{}, {}, skew {}", course_name, tracker.name, skew),
                          study::synthetic_drive(course, model, "run", study::derived_seed(kSeed, number++)),
                          tracker.is_sharp && std::abs(skew) < 1e-3});
      }
  return drives;
}

std::optional<ClockStep> step_in(const Trajectory& run) {
  return find_clock_step(run, search_clock(run, kWheelbase_m, {}), kWheelbase_m);
}

template <class Samples>
void step(Samples& samples, double by_s) {
  const double from_s = samples.front().time_s + 0.45 * (samples.back().time_s - samples.front().time_s);
  for (auto& at : samples) at.time_s += at.time_s > from_s ? by_s : 0;
}

TEST(ClockStep, NoneIsFoundWhereThereIsNone) {
  int looked_at = 0;
  for (const StudyDrive& drive : study_drives()) {
    const auto found = step_in(drive.run);
    EXPECT_FALSE(find_leap_without_way(drive.run, kWheelbase_m)) << drive.name;
    EXPECT_FALSE(found) << drive.name << ": " << found->by_s << " s";
    ++looked_at;
  }
  std::printf("looked at %d drives without steps\n", looked_at);
}

/// The leap of the stamps that the search and the stamps themselves settle on.
std::optional<StampLeap> leap_in(const Trajectory& run) {
  const ClockFit clock = search_clock(run, kWheelbase_m, {});
  if (const auto found = find_clock_step(run, clock, kWheelbase_m))
    if (const auto leap = find_leap(run, *found, clock)) return leap;
  return find_leap_without_way(run, kWheelbase_m);
}

TEST(ClockStep, IsFoundWithItsSizeInEitherStream) {
  int looked_at = 0, right = 0;
  for (const StudyDrive& drive : study_drives())
    for (const double by_s : {0.1, 0.2, 1.0})
      for (const bool wheels : {true, false}) {
        Trajectory run = drive.run;
        if (wheels)
          step(run.wheels, by_s);
        else
          step(run.truth, by_s);
        const auto leap = leap_in(run);
        // A period of the slowest stream is 0.1 s, of which the stamps' step may differ by jitter alone.
        const bool found =
            leap && std::abs(leap->by_s - by_s) < 0.01 && (leap->stream == StampedStream::odometry) == wheels;
        ++looked_at;
        right += found ? 1 : 0;
        EXPECT_TRUE(found || !drive.is_sharp || by_s < 0.15)
            << drive.name << ": " << by_s << " s of " << (wheels ? "wheels" : "truth");
      }
  std::printf("found %d of %d steps\n", right, looked_at);
}

TEST(ClockStep, LostSamplesAreNone) {
  for (const StudyDrive& drive : study_drives()) {
    Trajectory run = drive.run;
    const double at_s =
        run.wheels.front().time_s + 0.4 * (run.wheels.back().time_s - run.wheels.front().time_s);
    std::erase_if(run.wheels, [&](const WheelSample& at) { return std::abs(at.time_s - at_s) < 0.25; });
    std::erase_if(run.truth, [&](const BodySample& at) { return std::abs(at.time_s - at_s - 3) < 0.4; });
    const auto leap = leap_in(run);
    EXPECT_FALSE(leap) << drive.name << ": " << leap->by_s << " s";
  }
}

TEST(ClockStep, SamplesThatALinkHeldBackAreNone) {
  for (const StudyDrive& drive : study_drives())
    for (const double held_s : {0.08, 0.1, 0.12, 0.15, 0.2}) {
      Trajectory run = drive.run;
      const auto hold_back = [&](auto& samples) {
        const double until_s =
            samples.front().time_s + 0.55 * (samples.back().time_s - samples.front().time_s) + held_s;
        for (std::size_t i = 0; i < samples.size(); ++i)
          if (samples[i].time_s > until_s - held_s && samples[i].time_s < until_s)
            samples[i].time_s = std::max(until_s, samples[i - 1].time_s + 2e-4);
      };
      hold_back(run.truth);
      hold_back(run.wheels);
      const auto leap = leap_in(run);
      EXPECT_FALSE(leap) << drive.name << ", " << held_s << " s: " << leap->by_s << " s";
    }
}

TEST(ClockStep, WheelsThatAreCutWhileTheRobotMovesAreNone) {
  int looked_at = 0;
  for (const StudyDrive& drive : study_drives())
    for (const auto& [from, to] : {std::pair{0.0, 0.55}, {0.0, 0.7}, {0.3, 1.0}, {0.45, 1.0}, {0.25, 0.8}}) {
      Trajectory run = drive.run;
      const auto n = static_cast<double>(run.wheels.size());
      run.wheels.erase(run.wheels.begin() + std::lround(to * n), run.wheels.end());
      run.wheels.erase(run.wheels.begin(), run.wheels.begin() + std::lround(from * n));
      const ClockFit clock = search_clock(run, kWheelbase_m, {});
      if (clock.correlation < 0.5 || clock.rival_offset_s) continue;  // such a drive is refused
      const auto found = find_clock_step(run, clock, kWheelbase_m);
      EXPECT_FALSE(found) << drive.name << ", " << from << " to " << to << ": " << found->by_s << " s";
      ++looked_at;
    }
  std::printf("looked at %d drives with wheels that are cut\n", looked_at);
}

TEST(ClockStep, IsTakenBack) {
  Trajectory run = study_drives().front().run;
  const Trajectory before = run;
  step(run.truth, 0.5);
  const auto leap = leap_in(run);
  ASSERT_TRUE(leap);
  take_back(run, *leap);
  for (std::size_t i = 0; i < run.truth.size(); ++i)
    EXPECT_NEAR(run.truth[i].time_s, before.truth[i].time_s, 1e-9);
}

}  // namespace
}  // namespace astro::calibration
