#include <fmt/format.h>

#include <memory>

#include "common/safety/fault.hpp"
#include "host/cli/command.hpp"
#include "host/cli/connection.hpp"
#include "host/cli/console.hpp"
#include "host/cli/options.hpp"
#include "host/cli/robot_view.hpp"

namespace astro::cli {
namespace {

struct FaultOptions {
  ConnectionOptions connection;
  bool clear = false, json = false;
};

void run(FaultOptions& options) {
  const auto client = connect(options.connection);
  const protocol::FaultReport report = client->request(protocol::GetFaults{});
  const protocol::Pong now = client->request(protocol::Ping{});
  if (options.clear) client->request(protocol::ClearFaults{});
  const double ago_s = static_cast<double>(now.device_time_us - report.first_time_us) * 1e-6;
  if (options.json) {
    Json json = {{"faults", fault_list(report.latched)}, {"raised_since_start", report.raised_count}};
    json["first"] = report.latched == 0 ? Json() : Json(std::string(name(report.first)));
    json["first_seconds_ago"] = report.latched == 0 ? Json() : Json(ago_s);
    json["cleared"] = options.clear;
    return print(json);
  }
  if (report.latched == 0) return print(std::string("no fault is latched"));
  print(fmt::format("{}; {} came first, {:.1f} s ago{}", faults_in_words(report.latched), name(report.first),
                    ago_s, options.clear ? "; cleared" : ""));
}

}  // namespace

void add_faults(CLI::App& app) {
  const auto options = std::make_shared<FaultOptions>();
  CLI::App& command = *app.add_subcommand("faults", "what stopped the robot, and say that it has been seen");
  add_connection(command, options->connection);
  command.add_flag("--clear", options->clear,
                   "clear the latched faults, so that the robot can be armed again");
  add_json_flag(command, options->json);
  examples(command, {"astrolabe faults", "astrolabe faults --clear", "astrolabe faults --json"});
  command.callback([options] { run(*options); });
}

}  // namespace astro::cli
