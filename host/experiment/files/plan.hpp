#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/base/text/sense.hpp"
#include "host/calibration/end_poses/umbmark.hpp"
#include "host/recording/run.hpp"

/// What an experiment drives, in which order, and the name of each run.
namespace astro::experiment {

/// How the factors are found. automatic: by the scans if a laser scanner on the robot was recorded in all runs; by maximum likelihood
/// if all were recorded with ground truth along the way; otherwise by the robust fit of end poses.
struct MethodChoice {
  enum class Family { automatic, ml, scans, end_poses };
  Family family = Family::automatic;
  calibration::Options options;  // read by Family::end_poses
};

enum class Order { alternating, cw_first, ccw_first };

/// Drive until the standard errors of E_d, S and b / b are all below `target` (a ratio: 0.0005 for 0.05
/// %), but no more than `most` squares in each direction.
struct Until {
  double target = 0;
  int most = 50;
};

struct Plan {
  int runs = 5;  // squares in each direction and phase
  /// The precision that decides the number of squares in each phase that is calibrated; the last phase has `runs`.
  std::optional<Until> until;
  double side_m = 3;
  double speed_mps = 0.3;
  double yaw_rate_radps = 1.0;
  Order order = Order::alternating;
  int rounds = 1;  // how often to calibrate, upload and drive again
  double line_m = 3;
  double circle_radius_m = 0.75;
  /// Circles in each direction, and the turns of each: enough to determine e together with the squares' spins, although a
  /// circle of this radius shows only a quarter of e. With the slip of the thesis's robot, the standard error of e is 0.004
  /// with these and 0.02 with one circle of one turn each.
  int circles = 2, circle_turns = 3;
  /// Line and circles in the first and the last phase. If a person measures the ends, three lines are driven instead: they
  /// give the scale, one of the three may be wrong, and no method uses the end of a circle.
  bool extras = true;
  MethodChoice method;
  std::string truth;  // name of the source

  /// Throws astro::Error naming the value that cannot be driven.
  void check() const;
};

/// One drive of a plan.
struct RunSpec {
  std::string phase, kind;
  std::optional<Sense> direction;  // of squares and circles
  int index = 1;

  /// "square-cw-3.mcap"
  std::string file_name() const;
  /// "before: square cw 3", without a phase "square cw 3"
  std::string title() const;
  bool operator==(const RunSpec&) const = default;
};

/// "before", "after" for one round; "before", "after-1", ..., "after-N" for N rounds.
std::vector<std::string> phase_names(const Plan& plan);

/// Whether the squares of a phase are driven until a precision is reached.
bool open_ended(const Plan& plan, std::size_t phase);

/// The number of squares in each direction before the precision is computed first.
inline constexpr int kFewestPairs = 2;

/// The runs of one phase in the order of driving, with so many squares in each direction.
std::vector<RunSpec> runs_of_phase(const Plan& plan, std::size_t phase, int squares);
std::vector<RunSpec> squares_of_phase(const Plan& plan, std::size_t phase, int squares);

void to_json(nlohmann::json& json, const Plan& plan);
/// Throws nlohmann::json::exception for a missing key or a value of another type, and astro::Error for a number that is no
/// count or an unknown name. Call check() for the ranges.
void from_json(const nlohmann::json& json, Plan& plan);

std::string_view name_of(Order order);

}  // namespace astro::experiment
