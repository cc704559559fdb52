#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string_view>

#include "host/base/error.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/base/flags.hpp"
#include "host/commands/robot/commands.hpp"
#include "host/commands/robot/loader.hpp"
#include "host/commands/shared/connection.hpp"
#include "host/commands/shared/restart.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/console/console.hpp"
#include "host/console/options.hpp"
#include "host/formats/files/firmware_image.hpp"
#include "host/robot/client/handshake.hpp"
#include "host/robot/parameters/parameters.hpp"
#include "host/robot/port/ports.hpp"

namespace astro::commands {
namespace {

namespace fs = std::filesystem;
constexpr const char* kBuilt = "build/teensy40/bin/astrolabe-teensy40.hex";
constexpr std::string_view kBoard = "teensy40";

struct FlashOptions {
  ConnectionOptions connection;
  fs::path file = kBuilt;
  bool button = false, yes = false;
};

std::unique_ptr<robot::Client> find_robot(ConnectionOptions& options) {
  try {
    return connect(options);
  } catch (const Error& error) {
    const bool silent = dynamic_cast<const robot::LinkLost*>(&error) != nullptr;
    const bool absent = options.port.empty() ? robot::candidate_ports().empty() : !fs::exists(options.port);
    if (!silent && !absent) throw;
    throw Error(fmt::format("{} (if it runs no firmware, press its button and flash with --button)",
                            in_words(error)));
  }
}

void check_board(const protocol::HelloReply& robot, const fs::path& file) {
  if (robot.board.view() != kBoard)
    throw Error(fmt::format("{} is a '{}' and '{}' is for a '{}': name the port of another robot with --port",
                            robot.robot_name.view(), robot.board.view(), file.string(), kBoard));
}

bool is_for_this_board(const FirmwareImage& image) { return !image.version.empty() && image.board == kBoard; }

std::string describe(const FirmwareImage& image, const fs::path& file) {
  if (image.version.empty()) return fmt::format("'{}' is not firmware of Astrolabe", file.string());
  const std::string what = fmt::format("'{}' is firmware {} of Astrolabe", file.string(), image.version);
  if (image.board.empty()) return what + " and does not say for which board";
  return fmt::format("{} for the board '{}'", what, image.board);
}

/// Called before anything is erased.
void check_origin(const FirmwareImage& image, const FlashOptions& options) {
  if (is_for_this_board(image)) return console::say(describe(image, options.file));
  if (!options.yes && !console::confirm(fmt::format("{}. Flash it anyway?", describe(image, options.file))))
    throw Error("nothing was flashed");
}

void check_disarmed(robot::Client& client) {
  const protocol::Mode mode = client.request(protocol::GetStatus{}).mode;
  if (mode != protocol::Mode::disarmed && mode != protocol::Mode::fault)
    throw Error(fmt::format("the robot is armed ({}): 'astrolabe stop' disarms it", protocol::name(mode)));
}

void wait_for(robot::Client& client) {
  try {
    client.reconnect(std::chrono::seconds(10));
  } catch (const robot::LinkLost& error) {
    throw Error(
        fmt::format("the robot did not come back: {} (if its LED does not blink, press its button and flash "
                    "again with --button)",
                    in_words(error)));
  }
}

void check_version(const std::string& wanted, const std::string& now) {
  if (now != wanted)
    throw Error(fmt::format("the robot runs firmware {} and not {}: flash again", now, wanted));
}

void check_parameters(const robot::RemoteParameters& before, const robot::RemoteParameters& now) {
  for (const robot::ParameterRow& row : before.rows()) {
    const robot::ParameterRow* kept = now.find(row.name);
    if (kept == nullptr)
      throw Error(
          fmt::format("the new firmware has no parameter {}, which was {}: look at 'astrolabe params list'",
                      row.name, robot::describe(row, before.value(row.name))));
    if (now.value(row.name) != before.value(row.name))
      throw Error(fmt::format(
          "the parameters did not survive: {} was {} and is {}; set it with 'astrolabe params set'", row.name,
          robot::describe(row, before.value(row.name)), robot::describe(*kept, now.value(row.name))));
  }
}

void run(FlashOptions& options) {
  const FirmwareImage image = read_firmware_image(options.file);
  const fs::path loader = find_loader();
  check_origin(image, options);
  if (options.button) {
    console::say("press the button on the Teensy, unless it is in its boot loader already");
    run_loader(loader, options.file);
    return console::say(
        fmt::format("flashed {}; next, once its LED blinks: astrolabe info", options.file.string()));
  }
  const auto client = find_robot(options.connection);
  const std::string old = robot::firmware_version(client->robot());
  console::say(fmt::format("{} runs firmware {}", client->robot().robot_name.view(), old));
  check_board(client->robot(), options.file);
  check_disarmed(*client);
  const robot::RemoteParameters before = robot::RemoteParameters::fetch(*client);
  client->request(protocol::Disarm{});
  request_restart<protocol::EnterBootloader>(*client);
  run_loader(loader, options.file);
  if (!is_for_this_board(image))
    return console::say(
        fmt::format("flashed {}; whether it runs, 'astrolabe info' shows if it can", options.file.string()));
  wait_for(*client);
  check_version(image.version, robot::firmware_version(client->robot()));
  const robot::RemoteParameters now = robot::RemoteParameters::fetch(*client);
  check_parameters(before, now);
  console::say(fmt::format("flashed: firmware {} -> {}, all {} parameters kept", old,
                           robot::firmware_version(client->robot()), before.rows().size()));
}

constexpr Advice kFlashAdvice[] = {
    {ImageProblem::unreadable, ": build one with './dev firmware'"},
    {ImageProblem::too_large, ": build one with './dev firmware'"},
    {ImageProblem::of_other_board, ": build one with './dev firmware'"},
};

}  // namespace

void add_flash(console::Command app) {
  advise(kFlashAdvice);
  const auto options = std::make_shared<FlashOptions>();
  const console::Command command =
      app.add_subcommand("flash", "load new firmware into the robot, which must be disarmed");
  command.add_option("file", options->file, "image for the Teensy 4.0, as './dev firmware' builds it")
      .type_name("FILE")
      .capture_default_str();
  command.add_flag("--button", options->button, "do not contact the robot: a person presses its button");
  add_yes(command, options->yes, "flash also what is not Astrolabe's, or not for this board");
  add_connection(command, options->connection);
  console::examples(command, {"astrolabe flash", "astrolabe flash astrolabe-teensy40.hex --port /dev/ttyACM0",
                              "astrolabe flash --button"});
  command.callback([options] { run(*options); });
}

}  // namespace astro::commands
