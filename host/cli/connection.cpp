#include "host/cli/connection.hpp"

#include <algorithm>
#include <vector>

#include "host/link/discovery.hpp"

namespace astro::cli {
namespace {

std::string reasons(const std::vector<link::FoundPort>& silent) {
  std::string text;
  for (const link::FoundPort& found : silent) text += (text.empty() ? "" : "; ") + found.reason;
  return text;
}

std::string names(const std::vector<link::FoundPort>& robots) {
  std::string text;
  for (const link::FoundPort& found : robots)
    text += (text.empty() ? "" : ", ") + found.port.address + " (" +
            std::string(found.robot->robot_name.view()) + ")";
  return text;
}

}  // namespace

void add_connection_options(CLI::App& command, ConnectionOptions& options) {
  command
      .add_option("--port", options.port,
                  "Serial port, pty or tcp:localhost:PORT of the robot; without it the only robot found")
      ->type_name("PORT");
  command.add_option("--baud", options.baud, "Baud rate of a serial port")
      ->type_name("BAUD")
      ->capture_default_str()
      ->check(CLI::Range(1U, 20'000'000U));
}

std::string port_of(const ConnectionOptions& options) {
  if (!options.port.empty()) return options.port;
  auto found = link::find_robots(link::candidate_ports(), std::chrono::milliseconds(500), options.baud);
  const auto first_silent = std::stable_partition(found.begin(), found.end(),
                                                  [](const auto& port) { return port.robot.has_value(); });
  const std::vector<link::FoundPort> silent(first_silent, found.end());
  found.erase(first_silent, found.end());
  if (found.size() == 1) return found.front().port.address;
  if (found.size() > 1) throw Error("several robots are here: choose one with --port: " + names(found));
  if (!silent.empty()) throw Error("no robot answers: " + reasons(silent));
  throw Error(
      "no robot is here: plug one in, name its port with --port, or start a simulated one with 'astrolabe "
      "sim'");
}

std::unique_ptr<link::Client> connect(const ConnectionOptions& options) {
  auto client = std::make_unique<link::Client>(link::open_transport(port_of(options), options.baud));
  client->connect();
  return client;
}

}  // namespace astro::cli
