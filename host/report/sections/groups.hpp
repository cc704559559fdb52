#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/base/text/sense.hpp"
#include "host/report/sections/report.hpp"

/// The runs grouped for comparison: runs that were driven the same way, phase beside phase.
namespace astro::report {

struct RunGroup {
  std::string title;                                       // "Squares of 3 m, clockwise"
  std::string kind;                                        // of recording::RunInfo
  std::vector<std::vector<const recording::Run*>> phases;  // one list per phase of the input, by run index
  std::size_t most_runs() const;
};

/// Squares first, then circles, lines and the rest; clockwise before counter-clockwise. Runs without an
/// odometry sample are left out. The pointers live as long as `phases`.
std::vector<RunGroup> group_runs(const std::vector<Phase>& phases);

/// "clockwise", "counter-clockwise", "".
std::string direction_name(std::optional<Sense> direction);

}  // namespace astro::report
