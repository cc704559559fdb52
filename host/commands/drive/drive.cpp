#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "host/base/error.hpp"
#include "host/base/text/sense.hpp"
#include "host/commands/drive/commands.hpp"
#include "host/commands/drive/drive_job.hpp"
#include "host/console/options.hpp"

namespace astro::commands {
namespace {

// Longer than any drive; a larger number is probably in millimetres.
constexpr double kLongestSide_m = 100, kLongestLine_m = 1000;

void require_plausible(const char* what, double metres, double most_m) {
  if (std::abs(metres) > most_m)
    throw Error(
        fmt::format("a {} of {:g} m is more than the {:g} m that one drive may have: is it in metres?", what,
                    metres, most_m));
}

struct PathOptions {
  DriveOptions drive;
  robot::PathLimits limits;
  double length_m = 0, angle_deg = 0, radius_m = 0, turns = 1;
  bool cw = false, ccw = false;

  Sense sense() const { return cw ? Sense::cw : Sense::ccw; }
};

struct VelocityOptions {
  DriveOptions drive;
  double v_mps = 0, omega_radps = 0, seconds = 0;
};

console::Option add_number(console::Command command, const std::string& name, double& value,
                           const std::string& what) {
  return command.add_option(name, value, what).type_name("");
}

void add_limits(console::Command command, robot::PathLimits& limits) {
  add_number(command, "--speed", limits.speed_mps, "greatest speed in m/s; default: the robot's own limit")
      .type_name("M/S")
      .check(console::between(0.001, 100, "m/s"));
  add_number(command, "--yaw-rate", limits.yaw_rate_radps,
             "greatest yaw rate in rad/s; default: the robot's own limit")
      .type_name("RAD/S")
      .check(console::between(0.001, 100, "rad/s"));
}

void add_sense(console::Command command, PathOptions& options) {
  const console::Option ccw =
      command.add_flag("--ccw", options.ccw, "counter-clockwise, turning left (default)");
  command.add_flag("--cw", options.cw, "clockwise, turning right").excludes(ccw);
}

/// Adds a subcommand of `drive` that follows a path.
console::Command add_path(console::Command drive, const std::string& name, const std::string& what,
                          const std::shared_ptr<PathOptions>& options,
                          robot::Path (*path)(const PathOptions&)) {
  const console::Command command = drive.add_subcommand(name, what);
  add_limits(command, options->limits);
  add_drive_options(command, options->drive);
  command.callback([options, path] { drive_path(options->drive, path(*options)); });
  return command;
}

void add_line(console::Command drive) {
  const auto options = std::make_shared<PathOptions>();
  const console::Command command =
      add_path(drive, "line", "drive straight on", options, [](const PathOptions& o) {
        require_plausible("length", o.length_m, kLongestLine_m);
        return robot::line(o.length_m, o.limits);
      });
  add_number(command, "LENGTH", options->length_m, "metres; backwards if negative")
      .required()
      .check(console::finite());
  console::examples(command, {"astrolabe drive line 1", "astrolabe drive line -0.5 --speed 0.2",
                              "astrolabe drive line 2 --record line.mcap"});
}

void add_spin(console::Command drive) {
  const auto options = std::make_shared<PathOptions>();
  const console::Command command = add_path(
      drive, "spin", "turn on the spot", options,
      [](const PathOptions& o) { return robot::spin(robot::turns_from_degrees(o.angle_deg), o.limits); });
  add_number(command, "ANGLE", options->angle_deg, "degrees; to the left if positive")
      .required()
      .check(console::finite());
  console::examples(command, {"astrolabe drive spin 90", "astrolabe drive spin -3600 --yaw-rate 1"});
}

void add_arc(console::Command drive) {
  const auto options = std::make_shared<PathOptions>();
  const console::Command command =
      add_path(drive, "arc", "drive a part of a circle", options, [](const PathOptions& o) {
        require_plausible("length", o.length_m, kLongestLine_m);
        return robot::arc(o.length_m, robot::turns_from_degrees(o.angle_deg), o.limits);
      });
  add_number(command, "LENGTH", options->length_m, "metres along the arc; backwards if negative")
      .required()
      .check(console::finite());
  add_number(command, "ANGLE", options->angle_deg,
             "degrees that the heading changes; to the left if positive")
      .required()
      .check(console::finite());
  console::examples(command, {"astrolabe drive arc 1.5708 90", "astrolabe drive arc 2 -45 --speed 0.3"});
}

void add_square(console::Command drive) {
  const auto options = std::make_shared<PathOptions>();
  const console::Command command =
      add_path(drive, "square", "drive a square with turns on the spot", options, [](const PathOptions& o) {
        require_plausible("side", o.length_m, kLongestSide_m);
        return robot::square(o.length_m, o.sense(), o.limits);
      });
  add_number(command, "SIDE", options->length_m, "metres").required().check(console::positive("m"));
  add_sense(command, *options);
  console::examples(command,
                    {"astrolabe drive square 3 --cw", "astrolabe drive square 1 --ccw --speed 0.3 --json"});
}

void add_circle(console::Command drive) {
  const auto options = std::make_shared<PathOptions>();
  const console::Command command =
      add_path(drive, "circle", "drive circles beside the start", options, [](const PathOptions& o) {
        require_plausible("radius", o.radius_m, kLongestSide_m / 2);
        return robot::circle(o.radius_m, o.turns, o.sense(), o.limits);
      });
  add_number(command, "RADIUS", options->radius_m, "metres").required().check(console::positive("m"));
  add_sense(command, *options);
  add_number(command, "--turns", options->turns, "how many times round")
      .type_name("N")
      .capture_default_str()
      .check(console::positive(""));
  console::examples(command, {"astrolabe drive circle 1", "astrolabe drive circle 0.5 --cw --turns 3"});
}

void add_velocity(console::Command drive) {
  const auto options = std::make_shared<VelocityOptions>();
  const console::Command command = drive.add_subcommand("velocity", "hold a velocity for a while");
  add_number(command, "V", options->v_mps, "speed in m/s, forward positive")
      .required()
      .check(console::finite());
  add_number(command, "OMEGA", options->omega_radps, "yaw rate in rad/s, to the left positive")
      .required()
      .check(console::finite());
  add_number(command, "--for", options->seconds, "how long, in seconds on the robot's clock")
      .type_name("SECONDS")
      .required()
      .check(console::between(0.001, 86'400, "s"));
  add_drive_options(command, options->drive);
  console::examples(command,
                    {"astrolabe drive velocity 0.3 0 --for 2", "astrolabe drive velocity 0 -0.5 --for 10"});
  command.callback(
      [options] { drive_velocity(options->drive, options->v_mps, options->omega_radps, options->seconds); });
}

}  // namespace

void add_drive(console::Command app) {
  const console::Command command =
      app.add_subcommand("drive", "drive a path, hold a velocity or steer by keyboard");
  command.require_subcommand(1, 1);
  for (const auto add : {add_line, add_spin, add_arc, add_square, add_circle, add_velocity, add_drive_teleop})
    add(command);
  console::examples(command, {"astrolabe drive line 1", "astrolabe drive square 3 --cw --speed 0.5",
                              "astrolabe drive teleop"});
}

}  // namespace astro::commands
