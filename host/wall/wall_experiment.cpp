#include "host/wall/wall_experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "host/base/folder_lock.hpp"
#include "host/base/text/degrees.hpp"
#include "host/robot/parameters/parameters.hpp"
#include "host/wall/move_recorder.hpp"
#include "host/wall/wall_gyro.hpp"
#include "host/wall/wall_programme.hpp"

namespace astro::wall {
namespace {

using Kind = WallMove::Kind;

constexpr double kFurthestStart_m = 0.8;
constexpr int kDoubtsInARow = 3;

class Experiment {
 public:
  Experiment(robot::Client& client, const WallRobot& robot, const recording::RunInfo& info, double push_V,
             const std::filesystem::path& folder, WallJournal journal, const WallHooks& hooks)
      : folder_(folder),
        journal_(std::move(journal)),
        hooks_(hooks),
        robot_(robot),
        course_(plan_course(wishes_of(journal_.plan, robot), journal_.loaded)),
        driver_(client, robot, push_V, limits(), hooks.drive),
        runs_(read_moves(folder, journal_.moves.size(), info)) {
    if (robot.uses_gyro) recorder_.emplace(client, info);
    estimate();
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
    return {estimate_, journal_, robot_, is_precise(estimate_, journal_.plan.targets), gyro()};
  }

 private:
  robot::PathLimits limits() const {
    return {std::min(journal_.plan.speed_mps, robot_.speed_limit_mps),
            std::min(journal_.plan.yaw_rate_radps, robot_.yaw_rate_limit_radps)};
  }
  double robot_s() const { return 1e-6 * static_cast<double>(driver_.robot_us()); }
  WallSeries& series() { return journal_.drive.back(); }

  int total() const { return static_cast<int>(std::max(course_.moves.size(), journal_.moves.size() + 1)); }

  std::optional<WallMove> next() const { return next_move(journal_, estimate_, robot_); }
  bool readings_contradict() const { return estimate_.scale && estimate_.scale->contradictory(); }

  void estimate() { estimate_ = estimate_wall(journal_.drive, journal_.loaded, journal_.plan.usual_noise()); }

  std::optional<experiment::GyroResult> gyro() const {
    try {
      auto found = calibrate_gyro(runs_, journal_, estimate_);
      if (!found && robot_.uses_gyro)
        throw Error("it measured on no turn between two squarings: see that it is connected",
                    calibration::GyroProblem::no_rates);
      if (found) found->loaded_scale = robot_.gyro_scale;
      return found;
    } catch (const Error& error) {
      hooks_.drive.notice(error.in("the gyro is not calibrated: "));
      return std::nullopt;
    }
  }

  void begin_series() {
    hooks_.placed();
    const double began_s = robot_s();
    const WheelTravel flush = driver_.square(kFurthestStart_m).travel;
    journal_.driven_s += robot_s() - began_s;
    journal_.drive.push_back({{flush}, {}});
    if (recorder_) recorder_->take();
  }

  calibration::WheelFactors factors_to_drive_by() const {
    calibration::WheelFactors factors = estimate_.factors;
    const double loaded = (robot_.loaded.c_r + robot_.loaded.c_l) / 2,
                 found = (factors.c_r + factors.c_l) / 2;
    const double part = std::clamp(found / loaded, 1 / (1 + kFurther), 1 + kFurther) * loaded / found;
    factors.c_r *= part;
    factors.c_l *= part;
    factors.b_m *= part;
    return factors;
  }

  void drive(const WallMove& move) {
    const calibration::WheelFactors factors = factors_to_drive_by();
    if (move.kind == Kind::gap) {
      if (readings_contradict())
        hooks_.drive.notice(
            {"the readings of the ruler contradict each other; another one shows which is wrong",
             WallProblem::readings_contradict});
      driver_.drive(std::array{Leg{-move.away_m, 0}}, factors);
      read_gap();
    } else {
      driver_.drive(legs_away(move), factors);
    }
    const double margin_m = approach_margin_m(way_back(move), journal_.plan.body.width_m / 2, estimate_);
    const double left_m = std::min(margin_m, move.away_m);
    if (left_m < move.away_m) driver_.drive(std::array{Leg{move.away_m - left_m, 0}}, factors);
    const WallDriver::Flush flush = square_after(move, 2 * left_m + 0.05);
    keep(move, flush.travel, flush.crept_m - left_m);
  }

  /// If the squaring fails after one of the first moves with turns, the most likely cause is the robot's own
  /// factors.
  WallDriver::Flush square_after(const WallMove& move, double within_m) {
    try {
      return driver_.square(within_m);
    } catch (const NotFlush& failed) {
      if (move.turns == 0 || journal_.moves.size() >= kFirstMoves) throw;
      throw NotFlush(
          failed.in("perhaps because its wheels or its wheelbase are some percent from what it carries, "));
    }
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

  /// The travel of the wheels since the robot was flush, with the way back to the wall.
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
    const WheelTravel since = travel - series().squarings.back();
    ExpectedGap expected;
    expected.gap_m = backed_off_m(since, estimate_.factors);
    expected.loaded_m = backed_off_m(since, journal_.loaded);
    expected.read_before = estimate_.scale.has_value();
    if (estimate_.scale) expected.known = estimate_.scale->se;
    const BodySize& body = journal_.plan.body;
    auto gap_m = hooks_.read_gap(expected.gap_m);
    while (gap_m) {
      const auto doubt = doubt_about_gap(*gap_m, expected, body.front_to_axle_m, body.length_m);
      if (!doubt) break;
      const auto again_m = hooks_.read_again(*doubt);
      if (doubt->possible && again_m == gap_m) break;
      gap_m = again_m;
    }
    if (gap_m) series().readings.push_back({travel, *gap_m, series().squarings.size() - 1});
    waited_s_ = robot_s() - began_s;
  }

  void keep(const WallMove& move, const WheelTravel& flush, double further_m) {
    recording::Run run = recorder_ ? recorder_->take() : recording::Run{};
    series().squarings.push_back(flush);
    std::optional<Remark> doubt;
    if (const auto squaring = doubt_about_squaring(series(), estimate_, further_m))
      doubt = Remark{squaring->fact, squaring->kind};
    else if (move.turns != 0)
      doubt = doubt_by_gyro(run);
    if (doubt) return refuse(flush, *doubt);
    doubts_ = 0;
    journal_.moves.push_back(move);
    if (recorder_) write_move(folder_, journal_.moves.size(), run);
    runs_.push_back(std::move(run));
    estimate();
  }

  /// Whether the robot turned without its wheels in this move.
  std::optional<Remark> doubt_by_gyro(const recording::Run& run) const {
    constexpr std::size_t kFollowed = 4;  // moves that show how the gyro follows the wheels
    const std::size_t before = std::min(kFollowed, journal_.drive.back().squarings.size() - 2);
    const auto slips =
        unseen_turns_in(run, std::span(runs_).last(std::min(before, runs_.size())), estimate_.factors);
    if (slips.empty()) return std::nullopt;
    const auto furthest = std::ranges::max_element(
        slips, {}, [](const calibration::UnseenTurn& slip) { return std::abs(slip.slip.turn_rad); });
    return Remark{
        fmt::format("by its gyro the robot turned by {:.1f} degrees without its wheels, {:.1f} s after "
                    "it had left the wall",
                    degrees(std::abs(furthest->slip.turn_rad)), furthest->slip.begin_s),
        WallProblem::slipped};
  }

  /// The move that ended with this squaring does not count.
  void refuse(const WheelTravel& flush, const Remark& doubt) {
    series().squarings.pop_back();
    // A gap that was read since the last squaring is dropped, too, because somebody may have moved the
    // robot.
    std::erase_if(series().readings,
                  [&](const auto& reading) { return reading.squaring + 1 == series().squarings.size(); });
    if (++doubts_ == kDoubtsInARow)
      throw Error(doubt.sentence +
                      ": see that the wall is straight and firm, the front of the robot flat, and the floor "
                      "free and clean",
                  doubt.kind);
    hooks_.drive.notice({doubt.sentence + "; that way does not count, and is driven again", doubt.kind});
    journal_.drive.push_back({{flush}, {}});
  }

  const std::filesystem::path& folder_;
  WallJournal journal_;
  const WallHooks& hooks_;
  const WallRobot& robot_;
  WallCourse course_;
  WallDriver driver_;
  std::optional<MoveRecorder> recorder_;  // of a robot with a gyro
  MoveRuns runs_;                         // of the journal's moves
  WallEstimate estimate_;
  double waited_s_ = 0;
  int doubts_ = 0;
};

}  // namespace

WallResult run_wall_experiment(robot::Client& client, const WallPlan& plan,
                               const std::filesystem::path& folder, const WallHooks& hooks) {
  plan.check();
  const FolderLock lock(folder);  // two programs would drive into each other's series
  const auto parameters = robot::RemoteParameters::fetch(client);
  const WallRobot robot = wall_robot_of(parameters);
  const experiment::RobotIdentity identity = experiment::identity_of(client.robot());
  recording::RunInfo info;
  info.kind = "free";
  info.robot_name = identity.name;
  info.robot_id = identity.id;
  info.parameters = parameters.numbers();
  const double push_V = push_voltage_V(plan.push, robot);
  return Experiment(client, robot, info, push_V, folder, open_wall_journal(folder, plan, identity, robot),
                    hooks)
      .run();
}

}  // namespace astro::wall
