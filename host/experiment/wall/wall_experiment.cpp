#include "host/experiment/wall/wall_experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "host/robot/parameters/parameters.hpp"

namespace astro::experiment {
namespace {

using calibration::WallEstimate;
using calibration::WallMove;
using calibration::WallSeries;
using calibration::WheelTravel;
using Kind = calibration::WallMove::Kind;

constexpr double kFurthestStart_m = 0.8;
constexpr int kDoubtsInARow = 3;

class Experiment {
 public:
  Experiment(robot::Client& client, const WallRobot& robot, double push_V,
             const std::filesystem::path& folder, WallJournal journal, const WallHooks& hooks)
      : folder_(folder),
        journal_(std::move(journal)),
        hooks_(hooks),
        robot_(robot),
        course_(calibration::plan_course(wishes_of(journal_.plan, robot), journal_.loaded)),
        driver_(client, robot, push_V, limits(), hooks.drive) {
    estimate_ = calibration::estimate_wall(journal_.drive, journal_.loaded);
  }

  WallResult run() {
    if (next()) begin_series();
    for (auto move = next(); move; move = next()) {
      hooks_.move_started(*move, static_cast<int>(journal_.moves.size()) + 1, total());
      const double began_s = robot_s();
      waited_s_ = 0;
      drive(*move);
      journal_.driven_s += robot_s() - began_s - waited_s_;
      write_wall_journal(folder_, journal_);
      hooks_.squared(estimate_);
    }
    return {estimate_, journal_, robot_, is_precise()};
  }

 private:
  robot::PathLimits limits() const {
    return {std::min(journal_.plan.speed_mps, robot_.speed_limit_mps),
            std::min(journal_.plan.yaw_rate_radps, robot_.yaw_rate_limit_radps)};
  }
  double robot_s() const { return 1e-6 * static_cast<double>(driver_.robot_us()); }
  WallSeries& series() { return journal_.drive.back(); }

  /// With so few stretches K is hardly known, and a drive that happened to slip little must not end too early: what counts are the errors for a K
  /// that is one standard error larger.
  bool is_precise() const {
    const calibration::WallTargets& wanted = journal_.plan.targets;
    const auto stretches = static_cast<double>(std::max<std::size_t>(estimate_.stretches.size(), 1));
    const double surely = std::sqrt(1 + std::sqrt(2 / stretches));
    return estimate_.se.E_d * surely <= wanted.E_d && estimate_.se.b * surely <= wanted.b;
  }
  /// The moves that are driven whatever the precision: the repetitions, the first laps and the gaps.
  std::size_t fixed_moves() const { return 5 + static_cast<std::size_t>(journal_.plan.readings); }
  int total() const { return static_cast<int>(std::max(course_.moves.size(), journal_.moves.size() + 1)); }

  std::optional<WallMove> next() const {
    const std::size_t driven = journal_.moves.size();
    if (driven < fixed_moves()) return course_.moves[driven];
    if (is_precise()) return std::nullopt;
    const calibration::WallWishes wishes = wishes_of(journal_.plan, robot_);
    const int more = static_cast<int>(driven - fixed_moves());
    const bool laps = estimate_.se.E_d > journal_.plan.targets.E_d;
    WallMove move = laps ? calibration::laps_number(more, wishes) : calibration::spin_number(more, wishes);
    for (; move.turns != 0; move.turns -= move.turns > 0 ? 1 : -1)  // fewer turns may still be in time
      if (journal_.driven_s + calibration::time_of(move, wishes) <= 60 * journal_.plan.most_minutes)
        return move;
    return std::nullopt;
  }

  void begin_series() {
    hooks_.placed();
    const double began_s = robot_s();
    const WheelTravel flush = driver_.square(kFurthestStart_m).travel;
    journal_.driven_s += robot_s() - began_s;
    journal_.drive.push_back({{flush}, {}});
  }

  void drive(const WallMove& move) {
    const calibration::WheelFactors factors = estimate_.factors;
    if (move.kind == Kind::gap) {
      driver_.drive(std::array{Leg{-move.away_m, 0}}, factors);
      read_gap();
    } else {
      driver_.drive(legs_away(move), factors);
    }
    const double margin_m =
        calibration::approach_margin_m(way_back(move), journal_.plan.body.width_m / 2, estimate_);
    const double left_m = std::min(margin_m, move.away_m);
    if (left_m < move.away_m) driver_.drive(std::array{Leg{move.away_m - left_m, 0}}, factors);
    const WallDriver::Flush flush = driver_.square(2 * left_m + 0.05);
    keep(move, flush.travel, flush.crept_m - left_m);
  }

  static std::vector<Leg> legs_away(const WallMove& move) {
    std::vector<Leg> legs{{-move.away_m, 0}};
    if (move.kind == Kind::spin) legs.push_back({0, static_cast<double>(move.turns)});
    if (move.kind != Kind::laps) return legs;
    const double half = std::copysign(0.5, move.turns);
    for (int way = 0; way < 2 * std::abs(move.turns); ++way)
      legs.insert(legs.end(), {{0, half}, {move.line_m, 0}});
    return legs;
  }

  /// Of the wheels since the robot was flush, and back to the wall.
  WheelTravel way_back(const WallMove& move) {
    WheelTravel way = driver_.travel() - series().squarings.back();
    way.right_m += move.away_m;
    way.left_m += move.away_m;
    way.right_path_m += move.away_m;
    way.left_path_m += move.away_m;
    return way;
  }

  void read_gap() {
    const double began_s = robot_s();
    const WheelTravel travel = driver_.travel();
    const double expected_m =
        calibration::backed_off_m(travel - series().squarings.back(), estimate_.factors);
    constexpr double kUnknownScale = 0.01;
    const double known = estimate_.scale ? estimate_.scale->se : kUnknownScale;
    while (const auto gap_m = hooks_.read_gap(expected_m)) {
      const BodySize& body = journal_.plan.body;
      const auto doubt =
          calibration::doubt_about_gap(*gap_m, expected_m, known, body.front_to_axle_m, body.length_m);
      if (doubt && !hooks_.is_right(*doubt)) continue;
      series().readings.push_back({travel, *gap_m, series().squarings.size() - 1});
      break;
    }
    waited_s_ = robot_s() - began_s;
  }

  void keep(const WallMove& move, const WheelTravel& flush, double further_m) {
    series().squarings.push_back(flush);
    if (const auto doubt = calibration::doubt_about_squaring(series(), estimate_, further_m)) {
      series().squarings.pop_back();
      // A gap that was read on that way is of a robot that somebody moved.
      std::erase_if(series().readings,
                    [&](const auto& reading) { return reading.squaring + 1 == series().squarings.size(); });
      if (++doubts_ == kDoubtsInARow) throw Error(doubt->fact, {Help::check_wall});
      hooks_.drive.notice({doubt->fact + "; that way does not count, and is driven again"});
      journal_.drive.push_back({{flush}, {}});
      return;
    }
    doubts_ = 0;
    journal_.moves.push_back(move);
    estimate_ = calibration::estimate_wall(journal_.drive, journal_.loaded);
  }

  const std::filesystem::path& folder_;
  WallJournal journal_;
  const WallHooks& hooks_;
  const WallRobot& robot_;
  calibration::WallCourse course_;
  WallDriver driver_;
  WallEstimate estimate_;
  double waited_s_ = 0;
  int doubts_ = 0;
};

}  // namespace

calibration::WallWishes wishes_of(const WallPlan& plan, const WallRobot& robot) {
  calibration::WallWishes wishes;
  wishes.targets = plan.targets;
  wishes.line_m = plan.line_m;
  wishes.turning_m = plan.body.turning_gap_m();
  wishes.readings = plan.readings;
  wishes.gap_m = plan.gap_m;
  wishes.speed_mps = std::min(plan.speed_mps, robot.speed_limit_mps);
  wishes.yaw_rate_radps = std::min(plan.yaw_rate_radps, robot.yaw_rate_limit_radps);
  wishes.acceleration_mps2 = robot.acceleration_mps2;
  wishes.yaw_acceleration_radps2 = robot.yaw_acceleration_radps2;
  return wishes;
}

WallResult run_wall_experiment(robot::Client& client, const WallPlan& plan,
                               const std::filesystem::path& folder, const WallHooks& hooks) {
  plan.check();
  const WallRobot robot = wall_robot_of(robot::RemoteParameters::fetch(client));
  const double push_V = push_voltage_V(plan.push, robot);
  return Experiment(client, robot, push_V, folder,
                    open_wall_journal(folder, plan, identity_of(client.robot()), robot), hooks)
      .run();
}

}  // namespace astro::experiment
