#include "host/commands/shared/connection.hpp"

#include <fmt/format.h>

#include <array>
#include <set>

#include "host/base/error.hpp"
#include "host/commands/base/advice.hpp"
#include "host/console/console.hpp"
#include "host/console/interrupt.hpp"
#include "host/console/options.hpp"
#include "host/robot/sharing/shared_port.hpp"

namespace astro::commands {
namespace {

robot::SharedPorts& ports_of_this_program() {
  static robot::SharedPorts ports;
  return ports;
}

/// A robot that answers at two of its ports counts as one, and either port will do.
std::string only_robot(unsigned baud) {
  std::string robots, reasons, first;
  std::set<std::array<std::uint8_t, 16>> identities;
  for (const robot::FoundPort& found : find_robots(baud)) {
    if (found.robot) {
      if (first.empty()) first = found.port.address;
      robots += fmt::format("{}{} ({})", identities.empty() ? "" : ", ", found.port.address,
                            found.robot->robot_name.view());
      identities.insert(found.robot->unique_id);
    } else {
      reasons += (reasons.empty() ? "" : "; ") + in_words(found.reason);
    }
  }
  if (identities.size() == 1) return first;
  if (identities.size() > 1) throw Error("several robots are here, say with --port which one: " + robots);
  if (!reasons.empty()) throw Error("no robot was found: " + reasons);
  throw Error(
      "no robot was found: plug one in, start one with 'astrolabe sim', or name its port with --port");
}

}  // namespace

void add_connection(console::Command command, ConnectionOptions& options) {
  command
      .add_option(
          "--port,-p", options.port,
          "serial port or pty of the robot, shared with other programs\n(default: the only robot found)")
      .type_name("PORT");
  command.add_option("--baud", options.baud, "speed of a serial port; USB and ptys do not care")
      .type_name("BAUD")
      .capture_default_str()
      .check(console::whole(1, 20'000'000));
}

std::vector<robot::FoundPort> find_robots(unsigned baud) {
  return robot::find_robots(ports_of_this_program(), robot::candidate_ports(), std::chrono::milliseconds(500),
                            baud);
}

void leave_ports_to_others() { ports_of_this_program().leave_to_others(); }

std::unique_ptr<robot::Transport> open_port(const ConnectionOptions& options) {
  return ports_of_this_program().open(options.port.empty() ? only_robot(options.baud) : options.port,
                                      options.baud,
                                      [](const Remark& remark) { console::say(in_words(remark)); });
}

std::unique_ptr<robot::Client> connect(ConnectionOptions& options) {
  if (options.port.empty()) options.port = only_robot(options.baud);
  auto client = std::make_unique<robot::Client>(open_port(options));
  client->connect();
  return client;
}

std::unique_ptr<robot::Client> connect_to_drive(ConnectionOptions& options) {
  auto client = connect(options);
  client->learns_of_stop(client->request(protocol::GetStatus{}));
  return client;
}

robot::DriveHooks drive_hooks() {
  robot::DriveHooks hooks;
  hooks.interrupted = console::interrupted;
  hooks.notice = [](const Remark& remark) { console::say(in_words(remark)); };
  return hooks;
}

}  // namespace astro::commands
