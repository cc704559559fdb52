#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "host/base/pose2.hpp"
#include "host/base/text/degrees.hpp"
#include "host/truth/source/manual_source.hpp"
#include "tests/support/base/thorough.hpp"
#include "tests/support/robots/wall_desk.hpp"

// Wall and ruler against a tape measure, on the same fifty simulated robots.
namespace astro::wall {
namespace {

using support::robot_before_a_wall;
using support::TemporaryFolder;
using support::WallDesk;

constexpr int kRobots = 50;

struct Errors {
  double E_d = 0, b = 0, scale = 0;  // relative; b of b / S
};

struct Outcome {
  Errors error, in_se;  // in_se: in standard errors
  double minutes = 0, hardest_N = 0, stalled_s = 0;
};

Outcome by_wall(std::uint64_t seed) {
  const TemporaryFolder folder;
  WallDesk desk(robot_before_a_wall(seed));
  const WallResult found = run_wall_experiment(desk.desk.client, {}, folder.path(), desk.hooks());
  const WallEstimate& estimate = found.estimate;
  const Errors error{desk.E_d_error(estimate), desk.b_error(estimate), desk.scale_error(estimate)};
  return {error,
          {error.E_d / estimate.se.E_d, error.b / estimate.se.b, error.scale / estimate.se.scale},
          static_cast<double>(desk.board().world_us()) / 60e6,
          desk.board().wall_record().hardest_N,
          desk.board().wall_record().longest_stall_ticks / 1000.0};
}

/// A person who measures the ends of squares and lines with a tape: 3 mm and half a degree to either side.
class PersonWithTape {
 public:
  explicit PersonWithTape(sim::Board& board, std::uint64_t seed) : board_(board), random_(seed) {}

  void put_on_mark() { start_ = where(); }
  std::string answer(const truth::Question& question) {
    if (question.answer == truth::AnswerKind::right_or_entered_again) return "y";
    const Pose2 end = start_.between(where());
    if (question.text.find("x, forward") != std::string::npos)
      return fmt::format("{:.0f}", 1000 * end.x_m + off(3));
    if (question.text.find("y, left") != std::string::npos)
      return fmt::format("{:.0f}", 1000 * end.y_m + off(3));
    return fmt::format("{:.1f}", degrees(wrapped_rad(end.theta_rad)) + off(0.5));
  }

 private:
  double off(double most) { return std::uniform_real_distribution(-most, most)(random_); }
  Pose2 where() const {
    const sim::Pose pose = board_.truth();
    return {pose.x_m, pose.y_m, pose.theta_rad};
  }

  sim::Board& board_;
  std::mt19937_64 random_;
  Pose2 start_;
};

struct ByTape {
  Errors umbmark, robust;
};

Errors errors_of(const experiment::Calibration& found, const sim::Config& config) {
  const double scale = found.scale();
  return {found.factors.c_r / found.factors.c_l / config.true_ed - 1,
          found.factors.b_m / scale / (config.true_wheelbase_m / config.scale) - 1, scale / config.scale - 1};
}

/// Five squares of 3 m each way round, and three lines.
ByTape by_tape(std::uint64_t seed) {
  sim::Config config = robot_before_a_wall(seed);
  config.wall.reset();
  support::Desk desk(config);
  const TemporaryFolder folder;
  PersonWithTape person(desk.robot->board(), config.seed ^ 0x7A9E);
  experiment::Plan plan;
  plan.truth = "manual";
  ByTape found;
  experiment::ExperimentHooks hooks;
  hooks.ready = [&](const auto&, const auto&) { return person.put_on_mark(), experiment::Redo::no; };
  hooks.decide = [](const auto&, const auto&) { return experiment::Decision::keep; };
  hooks.force = true;
  truth::ManualSource tape([&](const truth::Question& question) { return person.answer(question); });
  const experiment::Results results =
      experiment::run_experiment(desk.client, tape, plan, folder.path(), hooks);
  const experiment::Squares& squares = results.before().squares();
  const auto with = [&](calibration::Method method) {
    return errors_of(
        experiment::calibrate(squares, {experiment::MethodChoice::Family::end_poses, {.method = method}}),
        config);
  };
  return {with(calibration::Method::umbmark), with(calibration::Method::robust)};
}

double median(std::vector<double> values) {
  for (double& value : values) value = std::abs(value);
  std::ranges::sort(values);
  return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
}

Errors medians(const std::vector<Errors>& errors) {
  std::array<std::vector<double>, 3> columns;
  for (const Errors& one : errors) {
    columns[0].push_back(one.E_d);
    columns[1].push_back(one.b);
    columns[2].push_back(one.scale);
  }
  return {median(columns[0]), median(columns[1]), median(columns[2])};
}

void print(const char* what, const Errors& errors) {
  fmt::print("{:<28} E_d {:.4f} %   b {:.4f} %   scale {:.4f} %\n", what, 100 * errors.E_d, 100 * errors.b,
             100 * errors.scale);
}

TEST(FiftyRobots, AreCalibratedByWallAndRulerInTenMinutesGently) {
  if (!support::thorough()) GTEST_SKIP() << support::kLeftToThorough;
  std::vector<Errors> wall, in_se, umbmark, robust;
  double minutes = 0, hardest_N = 0, stalled_s = 0;
  for (std::uint64_t seed = 1; seed <= kRobots; ++seed) {
    const Outcome one = by_wall(seed);
    wall.push_back(one.error);
    in_se.push_back(one.in_se);
    minutes = std::max(minutes, one.minutes);
    hardest_N = std::max(hardest_N, one.hardest_N);
    stalled_s = std::max(stalled_s, one.stalled_s);
    const ByTape tape = by_tape(seed);
    umbmark.push_back(tape.umbmark);
    robust.push_back(tape.robust);
  }
  fmt::print("median of the errors of {} robots (seeds 1 to {}):\n", kRobots, kRobots);
  print("wall and ruler", medians(wall));
  print("tape, UMBmark", medians(umbmark));
  print("tape, robust fit", medians(robust));
  fmt::print("longest {:.2f} min; hardest push {:.2f} N of {:g} N; longest stall {:.3f} s\n", minutes,
             hardest_N, PushLimit{}.force_N, stalled_s);
  const Errors found = medians(wall);
  EXPECT_LE(found.E_d, 2e-4);
  EXPECT_LE(found.b, 1e-3);
  EXPECT_LE(found.scale, 1e-3);
  EXPECT_LE(minutes, 10.0);
  EXPECT_LE(hardest_N, PushLimit{}.force_N);
  EXPECT_LE(stalled_s, 1.0);

  // Standard errors are honest: the median of |error| / se is 0.67 of a normal error. Of 50 it scatters by 0.1.
  const Errors ratio = medians(in_se);
  fmt::print("median of |error| / standard error: E_d {:.2f}, b {:.2f}, scale {:.2f}\n", ratio.E_d, ratio.b,
             ratio.scale);
  for (const double one : {ratio.E_d, ratio.b, ratio.scale}) {
    EXPECT_GT(one, 0.67 - 0.35);
    EXPECT_LT(one, 0.67 + 0.35);
  }
}

}  // namespace
}  // namespace astro::wall
