#include <memory>

#include "host/cli/command.hpp"
#include "host/cli/console.hpp"
#include "host/cli/options.hpp"
#include "host/cli/robot_view.hpp"
#include "host/link/discovery.hpp"

namespace astro::cli {
namespace {

Json as_json(const std::vector<link::FoundPort>& ports) {
  Json list = Json::array();
  for (const link::FoundPort& found : ports) {
    Json entry = {{"port", found.port.address},
                  {"device", found.port.device},
                  {"simulator", found.port.simulator},
                  {"robot", found.robot.has_value()}};
    if (found.robot) {
      entry["name"] = std::string(found.robot->robot_name.view());
      entry["id"] = hex_id(*found.robot);
      entry["firmware"] = firmware_version(*found.robot);
    } else {
      entry["reason"] = found.reason;
    }
    list.push_back(entry);
  }
  return list;
}

std::string as_text(const std::vector<link::FoundPort>& ports) {
  std::vector<std::vector<std::string>> rows;
  for (const link::FoundPort& found : ports)
    rows.push_back(
        {found.port.address, found.robot ? std::string(found.robot->robot_name.view()) : "no robot"});
  std::string text = table(rows);
  if (!text.empty()) text.pop_back();
  for (const link::FoundPort& found : ports)
    if (!found.robot) text += "\n" + found.port.address + ": " + found.reason;
  return text;
}

}  // namespace

void add_ports(CLI::App& app) {
  const auto json = std::make_shared<bool>(false);
  CLI::App& command =
      *app.add_subcommand("ports", "find robots at the serial ports and simulators of this machine");
  add_json_flag(command, *json);
  examples(command, {"astrolabe ports", "astrolabe ports --json"});
  command.callback([json] {
    const std::vector<link::FoundPort> ports = link::find_robots();
    if (*json) return print(as_json(ports));
    if (ports.empty()) return say("no serial port and no simulator is here; 'astrolabe sim' starts one");
    print(as_text(ports));
  });
}

}  // namespace astro::cli
