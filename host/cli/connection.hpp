#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "host/link/client.hpp"
#include "host/link/open_transport.hpp"

/// How a command finds its robot.
namespace astro::cli {

struct ConnectionOptions {
  std::string port;  // empty: the only robot that is here
  unsigned baud = link::kDefaultBaud;
};

/// Adds --port and --baud.
void add_connection_options(CLI::App& command, ConnectionOptions& options);

/// The port that was named; else that of the only robot found. Throws astro::Error with a sentence that lists
/// what is here if there is none or more than one.
std::string port_of(const ConnectionOptions& options);

/// Opens the port and shakes hands. Throws what open_transport and Client::connect throw.
std::unique_ptr<link::Client> connect(const ConnectionOptions& options);

}  // namespace astro::cli
