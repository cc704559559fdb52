#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "host/calibration/umbmark.hpp"
#include "host/recording/run.hpp"

/// What an experiment drives, in which order, and where each run is kept.
namespace astro::experiment {

/// How the factors are found. automatic: extended UMBmark, exact, where every square has an end heading;
/// UMBmark with averaged angles where not.
struct MethodChoice {
  bool automatic = true;
  calibration::Options options;  // read unless automatic
};

enum class Order { alternating, cw_first, ccw_first };

struct Plan {
  int runs = 5;  // squares in each direction and phase
  double side_m = 3;
  double speed_mps = 0.3;
  double yaw_rate_radps = 1.0;
  Order order = Order::alternating;
  int rounds = 1;  // calibrate, upload and drive again so often
  double line_m = 3;
  double circle_radius_m = 0.75;
  bool extras = true;  // line and circles in the first and the last phase
  MethodChoice method;
  std::string truth;  // name of the source

  /// Throws astro::Error naming the value that cannot be driven.
  void check() const;
};

/// One drive of a plan.
struct RunSpec {
  std::string phase, kind;
  recording::Direction direction = recording::Direction::none;
  int index = 1;

  /// "square-cw-3.mcap"
  std::string file_name() const;
  /// "before: square cw 3"
  std::string title() const;
};

/// "before", "after" for one round; "before", "after-1", ..., "after-N" for N rounds.
std::vector<std::string> phase_names(const Plan& plan);

/// The runs of one phase in the order of driving.
std::vector<RunSpec> runs_of_phase(const Plan& plan, std::size_t phase);

void to_json(nlohmann::json& json, const Plan& plan);
void from_json(const nlohmann::json& json, Plan& plan);

std::string_view name_of(recording::Direction direction);
std::string_view name_of(Order order);

}  // namespace astro::experiment
