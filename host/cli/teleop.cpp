#include "host/cli/teleop.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <memory>

#include "host/base/degrees.hpp"
#include "host/base/error.hpp"
#include "host/cli/drive_run.hpp"
#include "host/cli/keys.hpp"
#include "host/cli/limit_notes.hpp"
#include "host/cli/options.hpp"
#include "host/cli/robot_view.hpp"
#include "host/cli/steering.hpp"
#include "host/cli/terminal.hpp"

namespace astro::cli {
namespace {

struct TeleopOptions {
  DriveOptions drive;
  double speed_mps = 0.4, yaw_rate_radps = 1.0;  // gentle: a person reacts late
};

constexpr const char* kHelp =
    "     W or ↑   faster                space   stop\n"
    "     S or ↓   slower, backwards     Q       quit\n"
    "     A or ←   turn left\n"
    "     D or →   turn right\n\n";

std::string view(const std::string& robot, const SteeringWheel& wheel, const recording::OdometrySample& at) {
  constexpr int kHalf = 15;
  return fmt::format("\n  steering {}\n\n{}", robot, kHelp) +
         fmt::format("  speed     {}  {:+5.2f} m/s    is {:+6.3f}\n", gauge(wheel.forward(), kHalf),
                     wheel.v_mps(), at.v_mps) +
         // Left is left on the bar too.
         fmt::format("  turning   {}  {:+5.2f} rad/s  is {:+6.3f}\n\n", gauge(-wheel.left(), kHalf),
                     wheel.omega_radps(), at.omega_radps) +
         fmt::format("  odometry  x {:.3f} m   y {:.3f} m   heading {:.1f} deg\n", at.x_m, at.y_m,
                     degrees(at.theta_rad));
}

void run(TeleopOptions& options) {
  if (isatty(STDIN_FILENO) != 1 || isatty(STDERR_FILENO) != 1)
    throw Error(
        "teleop needs a terminal for keys and picture: run it in one, or use 'astrolabe drive velocity'");
  recording::OdometrySample at;
  DriveJob job;
  job.connected = [&](link::Client& client) {
    say_what_is_clamped(client, options.speed_mps, options.yaw_rate_radps);
  };
  job.moved = [&](const recording::OdometrySample& sample) { at = sample; };
  job.work = [&](link::Client& client, link::DriveSession& session) {
    RawTerminal terminal;
    Picture picture(STDERR_FILENO);
    Steering steering(client, session);
    SteeringWheel wheel(options.speed_mps, options.yaw_rate_radps);
    KeyReader reader;
    while (true) {
      for (const Key key : reader.read(terminal.typed())) {
        wheel.press(key);
        if (key == Key::quit) return;
      }
      steering.step(wheel.v_mps(), wheel.omega_radps());
      picture.draw(view(std::string(client.robot().robot_name.view()), wheel, at));
    }
  };
  drive(options.drive, job);
}

}  // namespace

void add_teleop(Command drive) {
  const auto options = std::make_shared<TeleopOptions>();
  const Command command = drive.add_subcommand("teleop", "steer by keyboard: arrow keys or W A S D");
  command.add_option("--speed", options->speed_mps, "greatest speed in m/s; each key is a fifth of it")
      .type_name("M/S")
      .capture_default_str()
      .check(between(0.001, 100, "m/s"));
  command.add_option("--yaw-rate", options->yaw_rate_radps, "greatest yaw rate in rad/s")
      .type_name("RAD/S")
      .capture_default_str()
      .check(between(0.001, 100, "rad/s"));
  add_drive_options(command, options->drive);
  examples(command, {"astrolabe drive teleop", "astrolabe drive teleop --speed 0.2 --yaw-rate 0.5",
                     "astrolabe drive teleop --record tour.mcap"});
  command.callback([options] { run(*options); });
}

}  // namespace astro::cli
