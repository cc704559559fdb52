#pragma once

#include <memory>
#include <string>

#include "host/experiment/drive/experiment.hpp"
#include "host/simulation/robot/in_process.hpp"
#include "tests/support/base/temporary_folder.hpp"

/// A simulated robot on a desk, in process and in virtual time: what scenario and experiment tests drive.
namespace astro::support {

/// The robot of the thesis: its wheels differ, and its wheelbase is not the nominal one.
inline sim::Config thesis_robot(double slip_m, std::uint64_t seed) {
  sim::Config config;
  config.true_ed = 1.00416;
  config.true_wheelbase_m = 0.99521 * config.nominal_wheelbase_m;
  config.slip_m = slip_m;
  config.seed = seed;
  return config;
}

inline constexpr double kThesisSlip_m = 2.645e-6;

struct Desk {
  explicit Desk(const sim::Config& config)
      : robot(
            std::make_shared<simulation::VirtualRobot>(config, simulation::MocapConfig{.seed = config.seed})),
        client(std::make_unique<simulation::InProcessTransport>(robot)),
        truth(robot) {
    client.connect();
    client.pump(std::chrono::milliseconds(50));  // through boot
  }

  std::shared_ptr<simulation::VirtualRobot> robot;
  robot::Client client;
  simulation::CameraTruth truth;
};

using test::TemporaryFolder;

}  // namespace astro::support
