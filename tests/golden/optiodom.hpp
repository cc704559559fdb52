#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/calibration/motion/trajectory.hpp"

/// The OptiOdom recordings of Sousa et al. (INESC TEC, MIT licence): a real robot, encoder ticks and
/// OptiTrack. Read where they are at hand (../shared/data/sousa_optiodom beside the checkout), never copied.
namespace astro::golden {

/// Of the robot: 84 mm wheels, 0.200 m wheelbase, 43.7 x 64 counts a turn.
inline constexpr double kOptiodomWheelbase_m = 0.2;

/// Empty if the data are not there.
std::filesystem::path optiodom_folder();

/// Squares recorded as Motive and the robot wrote them: 100 Hz rigid body with Y up (x = Z, y = X, heading =
/// rotation about Y), 20 Hz ticks of a clock of its own.
calibration::Trajectory raw_optiodom_run(const std::string& dataset, int run);

/// The same as the authors publish it: 20 Hz, clocks stretched onto each other by hand, truth of the robot's
/// centre from pose 0.
calibration::Trajectory synchronised_optiodom_run(const std::string& dataset, int run);

/// Of the sets that were driven in circles, which are at hand synchronised only.
calibration::Trajectory circular_optiodom_run(const std::string& dataset, int run);

}  // namespace astro::golden
