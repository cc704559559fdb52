#pragma once

#include <memory>
#include <string>
#include <vector>

#include "host/console/command_line.hpp"
#include "host/robot/client/client.hpp"
#include "host/robot/client/discovery.hpp"
#include "host/robot/motion/drive.hpp"
#include "host/robot/port/open_transport.hpp"

namespace astro::commands {

/// --port and --baud of every command that talks to a robot.
struct ConnectionOptions {
  std::string port;
  unsigned baud = robot::kDefaultBaud;
};

void add_connection(console::Command command, ConnectionOptions& options);

/// What answers at the candidate ports of this computer.
std::vector<robot::FoundPort> find_robots(unsigned baud);

/// Must be the last call of this program, after it has closed its ports. Other programs that use one can go on using it.
void leave_ports_to_others();

/// Opens the port, shared with other programs. Without --port it takes that of the only robot found, which may be another
/// robot at each call; throws astro::Error as connect() does.
std::unique_ptr<robot::Transport> open_port(const ConnectionOptions& options);

/// Connects to a robot and returns after its answer. Without --port it takes the only robot found; if there
/// is none or several, it throws astro::Error with one sentence that lists them. Sets `options.port` to the
/// port used.
std::unique_ptr<robot::Client> connect(ConnectionOptions& options);

/// The same for a command that drives: a stop by somebody else from now on also prevents its first drive. Not for a command
/// that stops the robot: its first request must be the stop, because a request for the status waits behind those of other
/// programs.
std::unique_ptr<robot::Client> connect_to_drive(ConnectionOptions& options);

/// Hooks that check for Ctrl-C and print notices on stderr.
robot::DriveHooks drive_hooks();

}  // namespace astro::commands
