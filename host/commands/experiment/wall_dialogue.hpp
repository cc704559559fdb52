#pragma once

#include <optional>
#include <string>

#include "host/commands/shared/press_enter.hpp"
#include "host/truth/source/reading.hpp"
#include "host/wall/gap_doubt.hpp"
#include "host/wall/wall_experiment.hpp"
#include "host/wall/wall_plan.hpp"

/// The dialogue with a person who has a wall and a ruler.
namespace astro::commands {

/// Before the first move: what the robot will do, for how long, how much floor it needs, and where to put robot and ruler.
/// `readings`: how many gaps are still to be read; `driven_s`: driving time in earlier sessions of the same calibration.
/// Lines of at most 80 columns.
std::string wall_briefing(const wall::WallPlan& plan, const wall::WallCourse& course, int readings,
                          double driven_s);

/// Waits for Enter alone, by which the person confirms that the robot faces the wall.
void ask_facing_wall(const AskLine& ask);

/// The gap between wall and front, in m; nothing if the answer is "none", not measured. Asks until the answer is one of
/// both.
std::optional<double> ask_gap(const AskLine& ask, double expected_m, truth::LengthUnit unit);

/// Asks for a doubtful gap again: a length, "none", or, if what was read is possible, "yes" to confirm it.
std::optional<double> ask_gap_again(const AskLine& ask, const wall::GapDoubt& doubt, truth::LengthUnit unit);

/// "2 laps counter-clockwise", for a progress bar.
std::string title_of(const wall::WallMove& move);

/// The result as a person reads it, at most 80 columns wide.
std::string wall_result_text(const wall::WallResult& result);

}  // namespace astro::commands
