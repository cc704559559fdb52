#pragma once

#include <memory>
#include <string>

#include "host/console/command_line.hpp"
#include "host/robot/client/client.hpp"
#include "host/robot/motion/drive.hpp"
#include "host/robot/port/open_transport.hpp"

namespace astro::commands {

/// --port and --baud of every command that talks to a robot.
struct ConnectionOptions {
  std::string port;
  unsigned baud = robot::kDefaultBaud;
};

void add_connection(console::Command command, ConnectionOptions& options);

/// A robot that has answered. Without --port: the only one found; throws astro::Error with one sentence that
/// lists what is here if there are none or several. `options.port` then says which it was.
std::unique_ptr<robot::Client> connect(ConnectionOptions& options);

/// Ctrl-C, and notices on stderr.
robot::DriveHooks drive_hooks();

}  // namespace astro::commands
