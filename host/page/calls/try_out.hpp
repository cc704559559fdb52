#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "host/page/calls/calls.hpp"

namespace astro::page {

/// A simulated robot drives squares, is calibrated, and drives them again: `umbmark` on a robot whose errors are known.
///
/// question  {"seed": 1, "E_d": 1.004, "E_b": 0.995, "S": 1, "e": 0, "slip": 1, "runs": 5, "side_m": 3}
///             E_d   diameter of the right wheel over that of the left
///             E_b   wheelbase as built over the nominal one
///             S     mean diameter as built over the nominal one
///             e     by how much gentle arcs turn about another wheelbase than spins
///             slip  times that of the robot of the thesis
///             wiring, counts_per_motor_rev  what is wrong with it (simulated_robot.hpp)
///             runs  squares in each direction and phase
/// events    {"event": "run", "title", "phase", "number", "total"} when a drive begins;
///           {"event": "way", "odometry": [x, y, ...], "truth": [x, y, ...]}, m, in the frame of the robot's start of this drive;
///           {"event": "calibrated", "calibration": what `calibrate --json` prints} before the robot drives again
/// answer    {"results": what `umbmark --json` prints, "built": the factors that would be exact,
///            "verdict": a paragraph, "report": the file of the report}
///
/// Throws astro::Error for sizes that no robot has, and what run_experiment throws.
nlohmann::json try_out(const nlohmann::json& question, const std::filesystem::path& folder, const Emit& emit);

}  // namespace astro::page
