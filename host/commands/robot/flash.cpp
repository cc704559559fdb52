#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string_view>

#include "host/base/error.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/robot/commands.hpp"
#include "host/commands/robot/image_search.hpp"
#include "host/commands/robot/loader.hpp"
#include "host/commands/robot/pico_drive.hpp"
#include "host/commands/shared/connection.hpp"
#include "host/commands/shared/restart.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/console/console.hpp"
#include "host/console/options.hpp"
#include "host/formats/files/firmware_image.hpp"
#include "host/formats/files/uf2_image.hpp"
#include "host/robot/client/handshake.hpp"
#include "host/robot/parameters/parameters.hpp"
#include "host/robot/port/ports.hpp"

namespace astro::commands {
namespace {

namespace fs = std::filesystem;
/// What a kind of image is for, and how it gets there.
struct Destination {
  std::string_view board, person_does;
};
constexpr Destination kHex{"teensy40",
                           "press the button on the Teensy, unless it is in its boot loader already"};
constexpr Destination kUf2{
    "rp2040", "hold BOOTSEL on the Pico while you plug it in, unless it is in its boot loader already"};

struct Loadable {
  FirmwareImage image;
  Destination destination;
};

Loadable read_image(const fs::path& file) {
  if (begins_as_uf2(file) || file.extension() == ".uf2") return {read_uf2_image(file), kUf2};
  return {read_firmware_image(file), kHex};
}

struct FlashOptions {
  ConnectionOptions connection;
  fs::path file;  // "": the image for the robot's board that is here
  bool button = false, force = false;
};

std::unique_ptr<robot::Client> find_robot(ConnectionOptions& options, const Destination& destination) {
  try {
    return connect(options);
  } catch (const Error& error) {
    const bool silent = dynamic_cast<const robot::LinkLost*>(&error) != nullptr;
    const bool absent = options.port.empty() ? robot::candidate_ports().empty() : !fs::exists(options.port);
    if (!silent && !absent) throw;
    throw Error(fmt::format("{} (if it runs no firmware, flash with --button: {})", in_words(error),
                            destination.person_does));
  }
}

void check_board(const protocol::HelloReply& robot, std::string_view board, const fs::path& file) {
  if (robot.board.view() != board)
    throw Error(fmt::format("{} is a '{}' and '{}' is for a '{}': name the port of another robot with --port",
                            robot.robot_name.view(), robot.board.view(), file.string(), board));
}

bool is_for_its_board(const Loadable& loadable) {
  return !loadable.image.version.empty() && loadable.image.board == loadable.destination.board;
}

std::string describe(const FirmwareImage& image, const fs::path& file) {
  if (image.version.empty()) return fmt::format("'{}' is not firmware of Astrolabe", file.string());
  const std::string what = fmt::format("'{}' is firmware {} of Astrolabe", file.string(), image.version);
  if (image.board.empty()) return what + " and does not say for which board";
  return fmt::format("{} for the board '{}'", what, image.board);
}

/// Called before anything is erased.
void check_origin(const Loadable& loadable, const FlashOptions& options) {
  const std::string what = describe(loadable.image, options.file);
  if (is_for_its_board(loadable)) return console::say(what);
  if (options.force) return console::say("warning: " + what);
  if (!console::stdin_is_terminal())
    throw Error(fmt::format("{}, so nothing was flashed (--force flashes it all the same)", what));
  if (!console::confirm(fmt::format("{}. Flash it anyway?", what))) throw Error("nothing was flashed");
}

/// Into a robot that waits in its boot loader, or will.
void load(const Loadable& loadable, const fs::path& loader, const fs::path& file) {
  if (loadable.destination.board == kUf2.board) return copy_to_pico(file);
  run_loader(loader, file);
}

void check_disarmed(robot::Client& client) {
  const protocol::Mode mode = client.request(protocol::GetStatus{}).mode;
  if (mode != protocol::Mode::disarmed && mode != protocol::Mode::fault)
    throw Error(fmt::format("the robot is armed ({}): 'astrolabe stop' disarms it", protocol::name(mode)));
}

void wait_for(robot::Client& client, const Destination& destination) {
  try {
    client.reconnect(std::chrono::seconds(10));
  } catch (const robot::LinkLost& error) {
    throw Error(fmt::format(
        "the robot did not come back: {} (if its LED does not blink, flash again with --button: {})",
        in_words(error), destination.person_does));
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

/// Without a robot that says which board it is, a Teensy is taken for granted.
fs::path image_that_is_here(FlashOptions& options) {
  if (options.button) return find_image(kHex.board);
  return find_image(find_robot(options.connection, kHex)->robot().board.view());
}

void run(FlashOptions& options) {
  if (options.file.empty()) options.file = image_that_is_here(options);
  const Loadable loadable = read_image(options.file);
  const FirmwareImage& image = loadable.image;
  const fs::path loader = loadable.destination.board == kHex.board ? find_loader() : fs::path();
  check_origin(loadable, options);
  if (options.button) {
    console::say(std::string(loadable.destination.person_does));
    load(loadable, loader, options.file);
    return console::say(
        fmt::format("flashed {}; next, once its LED blinks: astrolabe info", options.file.string()));
  }
  const auto client = find_robot(options.connection, loadable.destination);
  const std::string old = robot::firmware_version(client->robot());
  console::say(fmt::format("{} runs firmware {}", client->robot().robot_name.view(), old));
  check_board(client->robot(), loadable.destination.board, options.file);
  check_disarmed(*client);
  const robot::RemoteParameters before = robot::RemoteParameters::fetch(*client);
  client->request(protocol::Disarm{});
  request_restart<protocol::EnterBootloader>(*client);
  load(loadable, loader, options.file);
  if (!is_for_its_board(loadable))
    return console::say(
        fmt::format("flashed {}; whether it runs, 'astrolabe info' shows if it can", options.file.string()));
  wait_for(*client, loadable.destination);
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
    {Uf2Problem::unreadable, ": build one with './dev firmware rp2040'"},
    {Uf2Problem::too_large, ": build one with './dev firmware rp2040'"},
    {Uf2Problem::of_other_board, ": build one with './dev firmware rp2040'"},
    {Uf2Problem::damaged, "; './dev firmware rp2040' builds one"},
};

}  // namespace

void add_flash(console::Command app) {
  advise(kFlashAdvice);
  const auto options = std::make_shared<FlashOptions>();
  const console::Command command =
      app.add_subcommand("flash", "load new firmware into the robot, which must be disarmed");
  command
      .add_option(
          "file", options->file,
          ".hex for a Teensy 4.0, .uf2 for a Pico (default: the one for the robot's board, below build or as "
          "it was installed; with --button that for a Teensy)")
      .type_name("FILE");
  command.add_flag("--button", options->button, "do not contact the robot: a person presses its button");
  command.add_flag("--force", options->force, "flash also what is not Astrolabe's, or not for this board");
  add_connection(command, options->connection);
  console::examples(command, {"astrolabe flash", "astrolabe flash astrolabe-teensy40.hex --port /dev/ttyACM0",
                              "astrolabe flash --button",
                              "astrolabe flash build/rp2040/bin/astrolabe-rp2040.uf2 --port /dev/ttyACM0"});
  command.callback([options] { run(*options); });
}

}  // namespace astro::commands
