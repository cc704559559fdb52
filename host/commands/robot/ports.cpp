#include <memory>

#include "host/commands/base/advice.hpp"
#include "host/commands/base/flags.hpp"
#include "host/commands/robot/commands.hpp"
#include "host/commands/shared/connection.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/console/console.hpp"
#include "host/console/options.hpp"
#include "host/robot/client/handshake.hpp"
#include "host/robot/port/open_transport.hpp"

namespace astro::commands {
namespace {

struct PortsOptions {
  unsigned baud = robot::kDefaultBaud;
  bool json = false;
};

Json as_json(const std::vector<robot::FoundPort>& found) {
  Json list = Json::array();
  for (const robot::FoundPort& at : found) {
    Json entry = {{"port", at.port.address},
                  {"device", at.port.device},
                  {"simulator", at.port.simulator},
                  {"robot", nullptr}};
    if (at.robot) {
      entry["robot"] = {{"name", std::string(at.robot->robot_name.view())},
                        {"id", hex_id(*at.robot)},
                        {"board", std::string(at.robot->board.view())},
                        {"firmware", robot::firmware_version(*at.robot)}};
    } else {
      entry["reason"] = in_words(at.reason);
    }
    list.push_back(std::move(entry));
  }
  return list;
}

void show(const std::vector<robot::FoundPort>& found) {
  std::vector<std::vector<std::string>> rows{{"port", "robot", "board", "firmware"}};
  for (const robot::FoundPort& at : found)
    if (at.robot)
      rows.push_back({at.port.address, std::string(at.robot->robot_name.view()),
                      std::string(at.robot->board.view()), robot::firmware_version(*at.robot)});
  if (rows.size() > 1) write(console::table(rows, "llll"));
  if (rows.size() == 1) console::say("no robot was found; 'astrolabe sim' starts a simulated one");
  for (const robot::FoundPort& at : found)
    if (!at.robot) console::say("no robot: " + in_words(at.reason));
}

void run(const PortsOptions& options) {
  const auto found = find_robots(options.baud);
  if (options.json) return print_json(as_json(found));
  show(found);
}

constexpr Advice kPortsAdvice[] = {
    {robot::PortProblem::none_named, ": 'astrolabe ports' lists the robots that are here"},
};

}  // namespace

void add_ports(console::Command app) {
  advise(kPortsAdvice);
  const auto options = std::make_shared<PortsOptions>();
  const console::Command command =
      app.add_subcommand("ports", "find robots at serial ports, and your simulators");
  command.add_option("--baud", options->baud, "speed of serial ports; USB and ptys do not care")
      .type_name("BAUD")
      .capture_default_str()
      .check(console::whole(1, 20'000'000));
  add_json_flag(command, options->json);
  console::examples(command, {"astrolabe ports", "astrolabe ports --json | jq -r '.[].port'"});
  command.callback([options] { run(*options); });
}

}  // namespace astro::commands
