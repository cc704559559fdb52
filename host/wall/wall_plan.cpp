#include "host/wall/wall_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace astro::wall {
namespace {

using Kind = WallMove::Kind;

constexpr double kRepeat_m = 0.08, kFirstLine_m = 1;
constexpr int kLaps = 2;                          // between two squarings
constexpr int kFewestTurns = 3, kMostTurns = 10;  // of a spin

/// What the wheels of a nominal robot have travelled.
class NominalWheels {
 public:
  explicit NominalWheels(double b_m) : b_m_(b_m) {}

  void roll(double right_m, double left_m) {
    travel_.right_m += right_m;
    travel_.left_m += left_m;
    travel_.right_path_m += std::abs(right_m);
    travel_.left_path_m += std::abs(left_m);
  }
  void spin(int turns) {
    const double rim_m = std::numbers::pi * b_m_ * turns;
    roll(rim_m, -rim_m);
  }
  const WheelTravel& travel() const { return travel_; }

 private:
  double b_m_;
  WheelTravel travel_;
};

WallDrive nominal_drive(const std::vector<WallMove>& moves, const calibration::WheelFactors& loaded) {
  NominalWheels wheels(loaded.b_m);
  WallSeries series;
  series.squarings.push_back(wheels.travel());
  for (const WallMove& move : moves) {
    wheels.roll(-move.away_m / loaded.c_r, -move.away_m / loaded.c_l);
    if (move.kind == Kind::gap)
      series.readings.push_back({wheels.travel(), move.away_m, series.squarings.size() - 1});
    wheels.spin(move.turns);
    const double forward_m = 2 * std::abs(move.turns) * move.line_m;
    wheels.roll(forward_m / loaded.c_r, forward_m / loaded.c_l);
    wheels.roll(move.away_m / loaded.c_r, move.away_m / loaded.c_l);
    series.squarings.push_back(wheels.travel());
  }
  return {series};
}

double relative(double variance, double value) { return std::sqrt(variance) / value; }

}  // namespace

WallErrors expected_errors(const std::vector<WallMove>& moves, const calibration::WheelFactors& loaded,
                           const WallNoise& noise) {
  const WallDrive drive = nominal_drive(moves, loaded);
  std::vector<Stretch> stretches;
  const std::vector<WheelTravel>& squarings = drive[0].squarings;
  for (std::size_t i = 1; i < squarings.size(); ++i)
    stretches.push_back({squarings[i] - squarings[i - 1], 0, i == 1});
  const HeadingFit fit = fit_headings(stretches, loaded, noise);
  const Eigen::RowVector2d difference(1, -1), sum(0.5, 0.5);
  const double a = loaded.c_r / loaded.b_m;
  const auto scale = scale_of_gaps(drive, loaded, noise);
  return {relative((difference * fit.covariance * difference.transpose()).value(), a),
          relative((sum * fit.covariance * sum.transpose()).value(), a),
          scale ? scale->se : std::numeric_limits<double>::quiet_NaN()};
}

double time_of(const WallMove& move, const WallWishes& wishes) {
  constexpr double kSettle_s = 0.1, kSquaring_s = 4;
  const auto line_s = [&](double length_m) {
    const double ramp_m = wishes.speed_mps * wishes.speed_mps / wishes.acceleration_mps2;
    return kSettle_s + (length_m > ramp_m
                            ? length_m / wishes.speed_mps + wishes.speed_mps / wishes.acceleration_mps2
                            : 2 * std::sqrt(length_m / wishes.acceleration_mps2));
  };
  const auto spin_s = [&](double turns) {
    return kSettle_s + 2 * std::numbers::pi * turns / wishes.yaw_rate_radps +
           wishes.yaw_rate_radps / wishes.yaw_acceleration_radps2;
  };
  const int turns = std::abs(move.turns);
  double time_s = 2 * line_s(move.away_m) + kSquaring_s;
  if (move.kind == Kind::spin) time_s += spin_s(turns);
  if (move.kind == Kind::laps) time_s += 2 * turns * (line_s(move.line_m) + spin_s(0.5));
  return time_s;
}

WallMove laps_number(int index, const WallWishes& wishes) {
  return {Kind::laps, wishes.turning_m, index % 2 == 0 ? kLaps : -kLaps, wishes.line_m};
}

// Slip is of variance 2 pi N K / b, both squarings of 2 squaring^2.
WallMove spin_number(int index, const WallWishes& wishes, double b_m) {
  const WallNoise& noise = wishes.noise;
  const double even = noise.squaring_rad * noise.squaring_rad * b_m / (std::numbers::pi * noise.K_m);
  const int turns = static_cast<int>(std::ceil(std::clamp<double>(even, kFewestTurns, kMostTurns)));
  return {Kind::spin, wishes.turning_m, index % 2 == 0 ? turns : -turns, 0};
}

WallCourse plan_course(const WallWishes& wishes, const calibration::WheelFactors& loaded) {
  const auto errors = [&](const std::vector<WallMove>& moves) {
    return expected_errors(moves, loaded, wishes.noise);
  };
  std::vector<WallMove> moves(3, {Kind::repeat, kRepeat_m, 0, 0});
  const double first_m = std::min(kFirstLine_m, wishes.line_m);
  for (const int way : {1, -1}) moves.push_back({Kind::laps, wishes.turning_m, way, first_m});
  for (int i = 0; i < wishes.readings; ++i) moves.push_back({Kind::gap, wishes.gap_m, 0, 0});
  for (int i = 0; i < kMostMoves && errors(moves).E_d > wishes.targets.E_d; ++i)
    moves.push_back(laps_number(i, wishes));
  for (int i = 0; i < kMostMoves && errors(moves).b > wishes.targets.b; ++i)
    moves.push_back(spin_number(i, wishes, loaded.b_m));
  WallCourse course{moves, errors(moves), 0};
  for (const WallMove& move : moves) course.time_s += time_of(move, wishes);
  return course;
}

}  // namespace astro::wall
