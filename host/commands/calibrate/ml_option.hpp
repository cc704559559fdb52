#pragma once

#include <string>

#include "host/calibration/motion/trajectory.hpp"
#include "host/console/command_line.hpp"
#include "host/experiment/analysis/calibration.hpp"

namespace astro::commands {

/// --K, --sigma-xy, --sigma-theta and --clock: settings of maximum likelihood.
struct MlOption {
  calibration::NoiseModel noise;
  double sigma_theta_deg = 0;
  std::string clock;
  console::Option noise_option, clock_option;

  bool given() const { return noise_option.count() + clock_option.count() > 0; }
  experiment::MlChoice choice() const;
};

void add_ml(console::Command command, MlOption& option);

}  // namespace astro::commands
