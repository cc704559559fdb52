#pragma once

#include <memory>
#include <string>

#include "host/cli/command_line.hpp"
#include "host/link/client.hpp"
#include "host/link/drive.hpp"
#include "host/link/open_transport.hpp"

namespace astro::cli {

/// --port and --baud of every command that talks to a robot.
struct ConnectionOptions {
  std::string port;
  unsigned baud = link::kDefaultBaud;
};

void add_connection(Command command, ConnectionOptions& options);

/// A robot that has answered. Without --port: the only one found; throws astro::Error with one sentence that
/// lists what is here if there are none or several. `options.port` then says which it was.
std::unique_ptr<link::Client> connect(ConnectionOptions& options);

/// Ctrl-C, and notices on stderr.
link::DriveHooks drive_hooks();

}  // namespace astro::cli
