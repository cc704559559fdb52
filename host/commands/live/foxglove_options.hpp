#pragma once

#include <string>
#include <vector>

#include "host/commands/live/listen_option.hpp"
#include "host/console/command_line.hpp"
#include "host/live/driver/names.hpp"
#include "host/live/foxglove/foxglove_server.hpp"

namespace astro::commands {

/// Where viewers that speak Foxglove's protocol connect, and what they may do.
struct FoxgloveOptions : ListenOption {
  FoxgloveOptions() : ListenOption{"8765", {}} {}

  bool wanted = false;
  std::vector<std::string> origins;
  bool allow_commands = false;
};

/// Adds --foxglove, and --listen, --allow-origin and --allow-commands, which need it.
void add_foxglove_options(console::Command command, FoxgloveOptions& options);

/// Where a browser finds the server, and what to know if other computers can reach it.
std::string foxglove_announcement(const FoxgloveOptions& options, std::uint16_t port);

/// `name`: what viewers call the robot. Services that stop the robot are served to every viewer, under their `names`.
foxglove::Settings foxglove_settings(const FoxgloveOptions& options, const std::string& name,
                                     const live::Names& names);

}  // namespace astro::commands
