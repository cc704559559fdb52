#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "host/commands/base/flags.hpp"
#include "host/commands/robot/commands.hpp"
#include "host/commands/shared/connection.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/console/console.hpp"
#include "host/console/options.hpp"
#include "host/robot/client/handshake.hpp"

namespace astro::commands {
namespace {

struct InfoOptions {
  ConnectionOptions connection;
  bool json = false;
};

microseconds best_round_trip(robot::Client& client) {
  constexpr int kTrips = 16;
  microseconds best = microseconds::max();
  for (int i = 0; i < kTrips; ++i) {
    const microseconds sent = client.now();
    client.request(protocol::Ping{});
    best = std::min(best, client.now() - sent);
  }
  return best;
}

Json as_json(const robot::Client& client, const protocol::Status& status, microseconds round_trip) {
  const protocol::HelloReply& robot = client.robot();
  return {{"port", client.name()},
          {"name", std::string(robot.robot_name.view())},
          {"id", hex_id(robot)},
          {"board", std::string(robot.board.view())},
          {"firmware", robot::firmware_version(robot)},
          {"protocol", robot.protocol_version},
          {"mode", std::string(protocol::name(status.mode))},
          {"faults", fault_list(status.latched_faults)},
          {"battery_V", status.battery_mv / 1e3},
          {"uptime_s", static_cast<double>(status.device_time_us) / 1e6},
          {"reset_cause", std::string(protocol::name(status.reset_cause))},
          {"tick_hz", robot.tick_hz},
          {"tick_count", status.tick_count},
          {"tick_overruns", status.tick_overruns},
          {"queued_segments", status.queued_segments},
          {"rx_bad_frames", status.rx_bad_frames},
          {"round_trip_us", round_trip.count()}};
}

std::string as_text(const robot::Client& client, const protocol::Status& status, microseconds round_trip) {
  const protocol::HelloReply& robot = client.robot();
  std::string text;
  const auto line = [&](std::string_view what, const std::string& value) {
    text += fmt::format("{}{:<10}{}", text.empty() ? "" : "\n", what, value);
  };
  line("name", std::string(robot.robot_name.view()));
  line("port", client.name());
  line("board", fmt::format("{}, id {}", robot.board.view(), hex_id(robot)));
  line("firmware", fmt::format("{}, protocol {}", robot::firmware_version(robot), robot.protocol_version));
  line("mode", std::string(protocol::name(status.mode)));
  line("faults", faults_in_words(status.latched_faults));
  line("battery", fmt::format("{:.2f} V", status.battery_mv / 1e3));
  line("running", fmt::format("{} since {}", duration_in_words(status.device_time_us),
                              protocol::name(status.reset_cause)));
  line("control", fmt::format("{} Hz, {} ticks late", robot.tick_hz, status.tick_overruns));
  line("link", fmt::format("round trip {:.2f} ms, {} bad frames at the robot",
                           static_cast<double>(round_trip.count()) / 1e3, status.rx_bad_frames));
  return text;
}

void run(InfoOptions& options) {
  const auto client = connect(options.connection);
  const microseconds round_trip = best_round_trip(*client);
  const protocol::Status status = client->request(protocol::GetStatus{});
  if (options.json) {
    print_json(as_json(*client, status, round_trip));
  } else {
    print(as_text(*client, status, round_trip));
  }
}

}  // namespace

void add_info(console::Command app) {
  const auto options = std::make_shared<InfoOptions>();
  const console::Command command = app.add_subcommand("info", "show which robot answers and its state");
  add_connection(command, options->connection);
  add_json_flag(command, options->json);
  console::examples(command, {"astrolabe info", "astrolabe info --port /dev/ttyACM0",
                              "astrolabe info --json | jq .faults"});
  command.callback([options] { run(*options); });
}

}  // namespace astro::commands
