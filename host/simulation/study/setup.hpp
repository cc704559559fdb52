#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/base/text/sense.hpp"
#include "host/calibration/end_poses/replay.hpp"
#include "host/calibration/likelihood/maximum_likelihood.hpp"
#include "host/calibration/motion/trajectory.hpp"
#include "host/calibration/motion/wheel_factors.hpp"

/// What a study repeats: one robot, one programme of squares and circles, one ground truth.
namespace astro::simulation::study {

/// What is wrong with a set-up. Values: the seed's text; the model's name; for of_other_model also that of
/// the robot.
enum class SetupProblem {
  seed_not_whole,
  model_unknown,
  of_other_model,
  windup_not_simulated,
  count_rate_not_recorded
};

/// Which robot drives: kinematics and noise alone, or the firmware on the simulated board.
enum class Model { kinematic, simulator };
std::string_view name_of(Model model);
std::optional<Model> model_named(std::string_view name);

/// The defaults are the robot of the reference measurements: its errors, and the slip that gives their
/// scatter. The tracked body has no lever arm, and the counts of the kinematic robot have no resolution
/// limit; the estimators do not know that.
struct TrialSetup {
  Model model = Model::kinematic;
  int trials = 200;
  std::uint64_t seed = 1;
  int runs = 5;  // squares in each direction
  double side_m = 3;
  int circles = 0;  // in each direction, of two turns each, after the squares
  double circle_radius_m = 0.75;
  double wheelbase_m = 0.290;  // the parameter in the robot, with c_R = c_L = 1
  double E_d = 1.00416;        // D_R / D_L
  double E_b = 0.99521;        // b / (S wheelbase_m)
  double scale = 1.005;        // S, common to both wheels and the wheelbase
  double e = 0;                // gentle arcs turn about b (1 + e), spins about b
  /// DriveModel::windup_rad. If it is not zero, the squares have a stand after each spin and a line at the
  /// end (square_course_with_stands). Only the kinematic robot has it.
  double windup_rad = 0;
  calibration::NoiseModel noise{2.645e-6, 5e-4, 0.0026179938779914943};  // 0.15 degrees
  double count_rate_hz = 100, truth_rate_hz = 60;
  bool clock_known = true;
  double clock_offset_sd_s = 0.03;  // between runs; only if the clock is not known
  bool noise_known = false;         // whether maximum likelihood gets the true noise

  calibration::WheelFactors loaded() const { return {1, 1, wheelbase_m}; }
  calibration::WheelFactors actual() const;
  /// Number of runs in a trial.
  int run_count() const { return 2 * (runs + circles); }
  bool is_square(int run) const { return run < 2 * runs; }
  /// Whether e is one of the figures: the robot has one, or the circles could show one.
  bool shows_e() const { return e != 0 || circles > 0; }
  /// The options for maximum likelihood.
  calibration::MlOptions ml_options() const;

  /// Throws astro::Error if the set-up is for another kind of robot.
  void require(Model driven) const;

  /// Throws astro::Error naming what is not positive and finite, too many or too few trials or runs, an e or a
  /// wind-up that no tyre has, drives that do not fit into memory, or squares on which the errors turn the
  /// robot by half a turn.
  void check() const;
};

/// Keys as in the shard files. `setup_from` throws nlohmann::json::exception for a missing key or a value of
/// another type, and astro::Error for an unknown model or a count that is not a whole number.
nlohmann::json to_json(const TrialSetup& setup);
TrialSetup setup_from(const nlohmann::json& json);

/// Turns of a circle.
inline constexpr int kCircleTurns = 2;

/// The runs of a trial are numbered from 0, squares before circles, alternating clockwise and
/// counter-clockwise. "square ccw 1" is run 1.
Sense sense_of(int run);
std::string name_of(const TrialSetup& setup, int run);

/// The seed of all noise of a trial; it depends on (seed, trial) alone.
std::uint64_t seed_of(const TrialSetup& setup, int trial);

/// Robot's clock minus tracker's clock in each run of a trial; all 0 if the clock is known.
std::vector<double> clock_offsets_s(const TrialSetup& setup, int trial);

}  // namespace astro::simulation::study
