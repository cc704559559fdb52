#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <span>
#include <string>

#include "common/protocol/enums.hpp"
#include "common/protocol/fault_log.hpp"
#include "common/safety/fault.hpp"
#include "host/base/text/numbers.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/base/flags.hpp"
#include "host/commands/robot/commands.hpp"
#include "host/commands/shared/connection.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/console/console.hpp"
#include "host/console/interrupt.hpp"
#include "host/console/options.hpp"
#include "host/robot/client/refusal.hpp"
#include "host/robot/client/robot_problem.hpp"

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

using Entries = std::span<const protocol::FaultLogEntry>;

/// Newer firmware may have written numbers for which this version has no name.
template <class E>
std::string name_or_number(std::uint8_t value) {
  const std::string_view found = name(static_cast<E>(value));
  return found == "?" ? fmt::format("unknown ({})", value) : std::string(found);
}

std::string volts(std::int32_t mv) { return fmt::format("{:.2f} V", mv / 1e3); }
std::string speed(std::int32_t umps) { return fmt::format("{:.3f} m/s", without_minus_zero(umps / 1e6, 3)); }

/// The fault log as text: a table, the newest first, or a sentence if it is empty.
std::string fault_log_table(Entries entries) {
  if (entries.empty()) return "the fault log is empty: no fault has stopped this robot yet\n";
  const bool any_missed = std::ranges::any_of(entries, [](const auto& entry) { return entry.missed != 0; });
  std::vector<std::vector<std::string>> rows{
      {"number", "start", "after", "fault", "in mode", "battery", "left", "right"}};
  if (any_missed) rows[0].push_back("not logged before it");
  for (const protocol::FaultLogEntry& entry : entries) {
    rows.push_back({std::to_string(entry.number), std::to_string(entry.start),
                    duration_in_words(entry.device_time_us), name_or_number<Fault>(entry.fault),
                    name_or_number<protocol::Mode>(entry.mode), volts(entry.battery_mv),
                    speed(entry.left_umps), speed(entry.right_umps)});
    if (any_missed) rows.back().push_back(entry.missed == 0 ? "" : std::to_string(entry.missed));
  }
  return console::table(rows, "rrrllrrrr");
}

Json fault_log_json(Entries entries) {
  Json json = Json::array();
  for (const protocol::FaultLogEntry& entry : entries) {
    json.push_back({{"number", entry.number},
                    {"start", entry.start},
                    {"time_s", static_cast<double>(entry.device_time_us) / 1e6},
                    {"fault", name_or_number<Fault>(entry.fault)},
                    {"mode", name_or_number<protocol::Mode>(entry.mode)},
                    {"battery_V", entry.battery_mv / 1e3},
                    {"left_mps", entry.left_umps / 1e6},
                    {"right_mps", entry.right_umps / 1e6},
                    {"missed", entry.missed}});
  }
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

constexpr Advice kFaultsAdvice[] = {
    {robot::RobotProblem::faulted, "; remove its cause, then run 'astrolabe faults --clear'"},
};

}  // namespace

void add_faults(console::Command app) {
  advise(kFaultsAdvice);
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
