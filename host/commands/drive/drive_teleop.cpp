#include <unistd.h>

#include <memory>

#include "host/base/error.hpp"
#include "host/commands/drive/commands.hpp"
#include "host/commands/drive/drive_job.hpp"
#include "host/commands/drive/drive_teleop_view.hpp"
#include "host/commands/shared/limit_notes.hpp"
#include "host/console/console.hpp"
#include "host/console/keys.hpp"
#include "host/console/options.hpp"
#include "host/console/terminal.hpp"

namespace astro::commands {
namespace {

struct TeleopOptions {
  DriveOptions drive;
  double speed_mps = 0.4, yaw_rate_radps = 1.0;  // slow, because people react late
};

void run(TeleopOptions& options) {
  if (isatty(STDIN_FILENO) != 1 || isatty(STDERR_FILENO) != 1)
    throw Error(
        "teleop needs a terminal for keys and picture: run it in one, or use 'astrolabe drive velocity'");
  recording::OdometrySample at;
  DriveJob job;
  job.connected = [&](robot::Client& client) {
    note_limits(client, options.speed_mps, options.yaw_rate_radps);
  };
  job.moved = [&](const recording::OdometrySample& sample) { at = sample; };
  job.work = [&](robot::Client& client, robot::DriveSession& session) {
    console::RawTerminal terminal;
    console::Picture picture(STDERR_FILENO);
    Steering steering(client, session);
    console::SteeringWheel wheel(options.speed_mps, options.yaw_rate_radps);
    console::KeyReader reader;
    const std::string robot(client.robot().robot_name.view());
    if (!console::obeys_escapes(STDERR_FILENO)) console::say(teleop_keys());
    while (true) {
      for (const console::Key key : reader.read(terminal.typed())) {
        wheel.press(key);
        if (key == console::Key::quit) return;
      }
      steering.step(wheel.v_mps(), wheel.omega_radps());
      picture.draw(teleop_picture(robot, wheel, at, console::terminal_size(STDERR_FILENO)),
                   teleop_line(wheel, at));
    }
  };
  drive(options.drive, job);
}

}  // namespace

void add_drive_teleop(console::Command drive) {
  const auto options = std::make_shared<TeleopOptions>();
  const console::Command command = drive.add_subcommand("teleop", "steer by keyboard: arrow keys or W A S D");
  command.add_option("--speed", options->speed_mps, "greatest speed in m/s; each key is a fifth of it")
      .type_name("M/S")
      .capture_default_str()
      .check(console::between(0.001, 100, "m/s"));
  command.add_option("--yaw-rate", options->yaw_rate_radps, "greatest yaw rate in rad/s")
      .type_name("RAD/S")
      .capture_default_str()
      .check(console::between(0.001, 100, "rad/s"));
  add_drive_options(command, options->drive);
  console::examples(command, {"astrolabe drive teleop", "astrolabe drive teleop --speed 0.2 --yaw-rate 0.5",
                              "astrolabe drive teleop --record tour.mcap"});
  command.callback([options] { run(*options); });
}

}  // namespace astro::commands
