#include "host/cli/connection.hpp"

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/cli/console.hpp"
#include "host/cli/interrupt.hpp"
#include "host/link/discovery.hpp"

namespace astro::cli {
namespace {

std::string only_robot() {
  std::vector<std::string> robots;
  std::string reasons;
  for (const link::FoundPort& found : link::find_robots()) {
    if (found.robot) {
      robots.push_back(found.port.address);
    } else {
      reasons += "\n  " + found.port.address + ": " + found.reason;
    }
  }
  if (robots.size() == 1) return robots.front();
  if (robots.empty())
    throw Error(
        "no robot was found: plug one in, start one with 'astrolabe sim', or name its port with --port" +
        reasons);
  std::string list;
  for (const std::string& robot : robots) list += "\n  --port " + robot;
  throw Error(fmt::format("there are {} robots, say which one:{}", robots.size(), list));
}

}  // namespace

void add_connection(CLI::App& command, ConnectionOptions& options) {
  command.add_option("--port,-p", options.port,
                     "serial port or pty of the robot (default: the only robot found)");
  command.add_option("--baud", options.baud, "speed of a serial port; USB and ptys do not care")
      ->capture_default_str();
}

std::unique_ptr<link::Client> connect(ConnectionOptions& options) {
  if (options.port.empty()) options.port = only_robot();
  auto client = std::make_unique<link::Client>(link::open_transport(options.port, options.baud));
  client->connect();
  return client;
}

link::DriveHooks drive_hooks() {
  link::DriveHooks hooks;
  hooks.interrupted = interrupted;
  hooks.notice = [](const std::string& text) { say(text); };
  return hooks;
}

}  // namespace astro::cli
