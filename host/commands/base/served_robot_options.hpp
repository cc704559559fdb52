#pragma once

#include <cstddef>
#include <string>

#include "host/console/command_line.hpp"
#include "host/simulation/server/server.hpp"

/// What `astrolabe sim` and `astrolabe-emulator` have in common.
namespace astro::commands {

struct SimOptions {
  simulation::ServerConfig server;
  simulation::RobotOptions robot;
  simulation::MocapConfig mocap;
};

void add_sim_options(console::Command command, SimOptions& options);

/// Chooses the path of the pty if none is named, and that of a scanner; throws astro::Error if the flash file cannot be a robot's.
void prepare(SimOptions& options, std::size_t flash_bytes);

/// Prints where the robot is and serves it until Ctrl-C. `what`: "a simulated robot".
void serve(simulation::Server& server, const std::string& what);

}  // namespace astro::commands
