#include <fmt/format.h>

#include <memory>

#include "host/commands/base/flags.hpp"
#include "host/commands/robot/commands.hpp"
#include "host/commands/robot/fault_log_view.hpp"
#include "host/commands/shared/connection.hpp"
#include "host/commands/shared/fault_help.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/console/console.hpp"
#include "host/console/interrupt.hpp"
#include "host/console/options.hpp"

namespace astro::commands {
namespace {

struct FaultsOptions {
  ConnectionOptions connection;
  bool clear = false, log = false, json = false;
};

void show(const protocol::FaultReport& report) {
  if (report.latched == 0) return print("no fault is latched");
  std::vector<std::vector<std::string>> rows;
  for (unsigned i = 1; i < 32; ++i) {
    if ((report.latched >> i & 1U) == 0) continue;
    const auto fault = static_cast<Fault>(i);
    rows.push_back({robot::fault_names(1U << i), std::string(fault_help(fault))});
  }
  write(console::table(rows, "ll"));
  print(fmt::format("first: {}, {} after the robot's start", name(report.first),
                    duration_in_words(report.first_time_us)));
}

Json as_json(const protocol::FaultReport& report, bool cleared) {
  Json json = {{"latched", fault_list(report.latched)}, {"first", nullptr}, {"first_time_s", nullptr}};
  if (report.latched != 0) {
    json["first"] = std::string(name(report.first));
    json["first_time_s"] = static_cast<double>(report.first_time_us) / 1e6;
  }
  json["raised_since_start"] = report.raised_count;
  json["cleared"] = cleared;
  return json;
}

std::vector<protocol::FaultLogEntry> fetch_log(robot::Client& client) {
  constexpr std::size_t kMostEntries =
      1024;  // a fault log holds 128; a broken robot may never report its end
  std::vector<protocol::FaultLogEntry> entries;
  try {
    for (; entries.size() < kMostEntries; console::check_interrupt())
      entries.push_back(client.request(protocol::GetFaultLog{static_cast<std::uint16_t>(entries.size())}));
  } catch (const robot::RobotRefused& refused) {
    if (refused.code() != protocol::ErrorCode::out_of_range) throw;
  }
  return entries;
}

void show_log(robot::Client& client, bool json) {
  const auto entries = fetch_log(client);
  if (json) return print_json(fault_log_json(entries));
  write(fault_log_table(entries));
}

void run(FaultsOptions& options) {
  const auto client = connect(options.connection);
  if (options.log) return show_log(*client, options.json);
  const protocol::FaultReport report = client->request(protocol::GetFaults{});
  if (options.clear) client->request(protocol::ClearFaults{});
  if (options.json) return print_json(as_json(report, options.clear));
  show(report);
  if (options.clear && report.latched != 0) console::say("cleared; the robot stays disarmed");
}

}  // namespace

void add_faults(console::Command app) {
  const auto options = std::make_shared<FaultsOptions>();
  const console::Command command =
      app.add_subcommand("faults", "show what stopped the robot, and release it");
  const console::Option clear =
      command.add_flag("--clear", options->clear, "release all latched faults; the robot stays disarmed");
  command
      .add_flag("--log", options->log,
                "what stopped the robot before, restarts included: the newest first, with the start that it "
                "came in and the time since then")
      .excludes(clear);
  add_connection(command, options->connection);
  add_json_flag(command, options->json);
  console::examples(command, {"astrolabe faults", "astrolabe faults --clear", "astrolabe faults --log",
                              "astrolabe faults --json"});
  command.callback([options] { run(*options); });
}

}  // namespace astro::commands
