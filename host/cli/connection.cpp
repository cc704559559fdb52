#include "host/cli/connection.hpp"

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/cli/console.hpp"
#include "host/cli/interrupt.hpp"
#include "host/cli/options.hpp"
#include "host/link/discovery.hpp"
#include "host/link/shared_port.hpp"

namespace astro::cli {
namespace {

std::string only_robot(unsigned baud) {
  std::string robots, reasons, last;
  int count = 0;
  for (const link::FoundPort& found :
       link::find_robots(link::candidate_ports(), std::chrono::milliseconds(500), baud)) {
    if (found.robot) {
      robots += fmt::format("{}{} ({})", count++ == 0 ? "" : ", ", found.port.address,
                            found.robot->robot_name.view());
      last = found.port.address;
    } else {
      reasons += (reasons.empty() ? "" : "; ") + found.reason;
    }
  }
  if (count == 1) return last;
  if (count > 1) throw Error("several robots are here, say with --port which one: " + robots);
  if (!reasons.empty()) throw Error("no robot was found: " + reasons);
  throw Error(
      "no robot was found: plug one in, start one with 'astrolabe sim', or name its port with --port");
}

}  // namespace

void add_connection(Command command, ConnectionOptions& options) {
  command
      .add_option(
          "--port,-p", options.port,
          "serial port or pty of the robot, shared with other programs\n(default: the only robot found)")
      .type_name("PORT");
  command.add_option("--baud", options.baud, "speed of a serial port; USB and ptys do not care")
      .type_name("BAUD")
      .capture_default_str()
      .check(whole(1, 20'000'000));
}

std::unique_ptr<link::Client> connect(ConnectionOptions& options) {
  if (options.port.empty()) options.port = only_robot(options.baud);
  auto client = std::make_unique<link::Client>(
      link::open_shared_port(options.port, options.baud, [](const std::string& sentence) { say(sentence); }));
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
