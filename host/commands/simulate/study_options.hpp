#pragma once

#include <string>

#include "host/calibration/motion/trajectory.hpp"
#include "host/console/command_line.hpp"

/// Options that 'study' and 'plan' share; each shows the present value as its default.
namespace astro::commands {

void add_count(console::Command command, const std::string& name, int& value, int least, int greatest,
               const std::string& what);
/// Metres, above 0 and below a kilometre.
void add_size(console::Command command, const std::string& name, double& metres, const std::string& what);
void add_ratio(console::Command command, const std::string& name, double& ratio, const std::string& what);
void add_rate(console::Command command, const std::string& name, double& hz, const std::string& what);

/// --slip (also --K), --sigma-xy, --sigma-theta in degrees, --truth-rate.
void add_noise(console::Command command, calibration::NoiseModel& noise, double& sigma_theta_deg,
               double& truth_rate_hz);

}  // namespace astro::commands
