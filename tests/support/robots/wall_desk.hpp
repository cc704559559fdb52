#pragma once

#include <cmath>
#include <random>

#include "host/wall/wall_experiment.hpp"
#include "tests/support/robots/desk.hpp"

/// A simulated robot in front of a wall, and a person with a ruler.
namespace astro::support {

/// Of a robot as a builder has it: wheels and wheelbase off by some thousandths, the slip of the thesis, motors that differ, a front that is not
/// quite square to the axle, a wall that is even to a third of a millimetre.
inline sim::Config robot_before_a_wall(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  sim::Config config;
  config.true_ed = 1 + 0.004 * normal(random);
  config.scale = 1 + 0.005 * normal(random);
  config.true_wheelbase_m = config.nominal_wheelbase_m * config.scale * (1 + 0.005 * normal(random));
  config.motor_mismatch = 0.05 * normal(random);
  config.slip_m = kThesisSlip_m;
  config.seed = random();
  config.body.front_turned_rad = 0.01 * normal(random);
  config.wall = sim::WallConfig{
      .x_m = config.body.ahead_m + std::uniform_real_distribution(0.05, 0.2)(random), .unevenness_m = 0.0003};
  return config;
}

/// Coarse targets: a calibration of two minutes.
inline wall::WallPlan quick_plan() {
  wall::WallPlan plan;
  plan.targets = {1e-3, 3e-3};
  plan.line_m = 2;
  plan.gap_m = 1;
  return plan;
}

/// Puts the robot in front of the wall by eye, and reads the ruler to the millimetre, with half a millimetre of error.
class WallDesk {
 public:
  explicit WallDesk(const sim::Config& robot) : config(robot), desk(robot), person_(robot.seed ^ 0x9E37) {}

  /// Somebody turns the robot by up to 0.1 rad.
  void put() {
    const double oblique_rad = std::uniform_real_distribution(-0.1, 0.1)(person_);
    board().place({0, 0, oblique_rad});
  }
  double read_gap_m() {
    const double read_mm = 1000 * board().wall()->front_gap_m(board().truth()) + 0.5 * normal_(person_);
    return std::round(read_mm) / 1000;
  }
  wall::WallHooks hooks() {
    wall::WallHooks hooks;
    hooks.placed = [this] { put(); };
    hooks.read_gap = [this](double) { return std::optional(read_gap_m()); };
    return hooks;
  }
  sim::Board& board() { return desk.robot->board(); }

  // Errors of an estimate: relative.
  double E_d_error(const wall::WallEstimate& found) const { return found.E_d / config.true_ed - 1; }
  double b_error(const wall::WallEstimate& found) const {
    return found.b_per_scale_m / (config.true_wheelbase_m / config.scale) - 1;
  }
  double scale_error(const wall::WallEstimate& found) const {
    return (found.factors.c_r + found.factors.c_l) / 2 / config.scale - 1;
  }

  sim::Config config;
  Desk desk;

 private:
  std::mt19937_64 person_;
  std::normal_distribution<double> normal_;
};

}  // namespace astro::support
