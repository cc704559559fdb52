#pragma once

#include <string>
#include <vector>

#include "host/console/command_line.hpp"
#include "host/live/driver/names.hpp"
#include "host/live/foxglove/foxglove_server.hpp"

namespace astro::commands {

/// Where viewers that speak Foxglove's protocol connect, and what they may do.
struct FoxgloveOptions {
  bool wanted = false;
  std::string listen = "8765";  // see foxglove_address_in
  console::Option listening;    // that option
  std::vector<std::string> origins;
  bool allow_commands = false;
};

/// Adds --foxglove, and --listen, --allow-origin and --allow-commands, which need it.
void add_foxglove_options(console::Command command, FoxgloveOptions& options);

/// If `port` is a bare number, it is the viewers' port, as with other viewer servers, because no robot's port is a bare
/// number. Moves it from `port` to `options`. Throws WrongUsage if it is no valid port, or if --listen is given, too.
void take_viewers_port(std::string& port, FoxgloveOptions& options);

/// "8765", "localhost:8765", "0.0.0.0:8765" or "[::1]:8765". Throws astro::Error that names the word otherwise.
foxglove::Address foxglove_address_in(const std::string& word);

/// Where a browser finds the server, and what to know if other computers can reach it.
std::string foxglove_announcement(const FoxgloveOptions& options, std::uint16_t port);

/// `name`: what viewers call the robot. Services that stop the robot are served to every viewer, under their `names`.
foxglove::Settings foxglove_settings(const FoxgloveOptions& options, const std::string& name,
                                     const live::Names& names);

}  // namespace astro::commands
