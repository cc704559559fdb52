#pragma once

#include <nlohmann/json_fwd.hpp>

#include "host/simulation/robot/robot_options.hpp"

namespace astro::page {

/// The robot that a question asks for, in ratios to a perfect one: E_d and E_b of its wheels and its wheelbase, S of its
/// lengths, e, slip (times that of the reference robot), and the seed of its noise; the counts per motor turn of its encoders, and
/// what is wrong with its wires (a list of simulation::wiring_fault_names()). What is missing is that of the reference robot.
/// Throws astro::Error that names a member which is of the wrong type or out of its range, or an unknown fault.
sim::Config simulated_robot_in(const nlohmann::json& question);

}  // namespace astro::page
