#include <fmt/format.h>

#include <memory>

#include "host/cli/command.hpp"
#include "host/cli/connection.hpp"
#include "host/cli/console.hpp"
#include "host/cli/options.hpp"

namespace astro::cli {
namespace {

struct RebootOptions {
  ConnectionOptions connection;
  bool bootloader = false;
};

// The restart itself takes the link with it: whether a request was heard shows in what comes after it.
void wait_for_start(link::Client& client) {
  constexpr auto kPatience = std::chrono::seconds(10);
  bool booted = false;
  const auto subscription = client.on<protocol::Booted>([&](const protocol::Booted&) { booted = true; });
  try {
    client.pump_until([&] { return booted; }, std::chrono::milliseconds(500));
  } catch (const link::LinkLost&) {  // a USB device goes away and comes again
  }
  client.reconnect(kPatience);
}

void run(RebootOptions& options) {
  const auto client = connect(options.connection);
  if (options.bootloader) {
    client->request(protocol::EnterBootloader{});
    return say("the robot is in its bootloader and waits for firmware");
  }
  client->request(protocol::Reboot{});
  wait_for_start(*client);
  const protocol::Status status = client->request(protocol::GetStatus{});
  say(fmt::format("the robot is back ({}), {}", protocol::name(status.reset_cause),
                  protocol::name(status.mode)));
}

}  // namespace

void add_reboot(CLI::App& app) {
  const auto options = std::make_shared<RebootOptions>();
  CLI::App& command = *app.add_subcommand("reboot", "restart the robot, which must be at rest");
  command.add_flag("--bootloader", options->bootloader, "stay in the bootloader and wait for new firmware");
  add_connection(command, options->connection);
  examples(command, {"astrolabe reboot", "astrolabe reboot --bootloader --port /dev/ttyACM0"});
  command.callback([options] { run(*options); });
}

}  // namespace astro::cli
