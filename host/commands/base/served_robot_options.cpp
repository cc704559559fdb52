#include "host/commands/base/served_robot_options.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "host/base/error.hpp"
#include "host/base/text/numbers.hpp"
#include "host/commands/base/advice.hpp"
#include "host/console/console.hpp"
#include "host/console/interrupt.hpp"
#include "host/console/options.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/robot/port/ports.hpp"
#include "host/simulation/server/pty.hpp"

namespace astro::commands {
namespace {

namespace fs = std::filesystem;

void check_folder(const char* option, const fs::path& path) {
  if (path.empty()) return;
  const fs::path folder = fs::absolute(path).parent_path();
  if (!fs::is_directory(folder))
    throw Error(fmt::format("{}: there is no folder '{}' for '{}'", option, folder.string(), path.string()));
}

constexpr std::size_t kSectorBytes = 4096;

void check_flash(const fs::path& path, std::size_t bytes) {
  if (path.empty()) return;
  check_folder("--flash", path);
  if (!fs::exists(path)) return;
  if (!fs::is_regular_file(path)) throw Error("--flash: '" + path.string() + "' is not a file");
  // A file that is shorter by whole sectors comes from an earlier version, which had fewer.
  if (const auto size = fs::file_size(path); size == 0 || size > bytes || size % kSectorBytes != 0)
    throw Error(fmt::format("--flash: '{}' has {} bytes and a robot's flash {}: it is another file",
                            path.string(), fs::file_size(path), bytes));
}

// The pty of a killed simulator no longer exists, but its number may be reused for ours in a moment; then its
// link would look alive.
void remove_dead_link(const fs::path& link) {
  std::error_code error;
  if (fs::is_symlink(link, error) && !fs::exists(link, error)) fs::remove(link, error);
}

// A simulator elsewhere works without its link in the runtime folder, so a failure is only reported.
std::optional<simulation::RuntimeLink> link_in_runtime_folder(const fs::path& pty) {
  try {
    return std::optional<simulation::RuntimeLink>(std::in_place, robot::make_runtime_folder(), pty);
  } catch (const Error& error) {
    console::say(fmt::format("'astrolabe ports' will not find this robot: {}", in_words(error)));
    return std::nullopt;
  }
}

void add_build_options(console::Command command, simulation::RobotOptions& robot) {
  command
      .add_option("--wiring", robot.wiring_faults,
                  "built with this fault: " + simulation::wiring_fault_names())
      .type_name("FAULT,...")
      .delimiter(',')
      .check(simulation::wrong_wiring_fault);
  command
      .add_option("--counts-per-rev", robot.counts_per_motor_rev,
                  "true counts per motor revolution of the encoders")
      .type_name("N")
      .capture_default_str()
      .check(console::between(1, 65536, "counts"));
  add_ranged(command, "--motor-mismatch", robot.motor_mismatch,
             "constant of the right motor over that of the left one, minus one", "RATIO", -0.5, 0.5, "");
  command.add_flag("--on-stand", robot.on_stand, "with the wheels off the ground");
  command.add_flag("--gyro", robot.gyro,
                   "with a gyro, which the robot uses once its parameter gyro_axis is 3");
}

void add_robot_options(console::Command command, simulation::RobotOptions& robot) {
  add_ranged(command, "--true-wheelbase", robot.true_wheelbase_m, "wheelbase that the robot really has, in m",
             "M", 0.05, 2, "m");
  add_ranged(command, "--true-ed", robot.true_ed, "true ratio of the wheel diameters, right over left",
             "RATIO", 0.5, 2, "");
  add_ranged(
      command, "--true-e", robot.true_e,
      "true curvature effect: gentle arcs turn about the true wheelbase times 1 + this, spins about it",
      "RATIO", -0.2, 0.2, "");
  add_ranged(command, "--true-kappa0", robot.true_kappa0,
             "curvature of a path, times the wheelbase, at which half of --true-e acts", "RATIO", 0.01, 10,
             "");
  add_ranged(command, "--scale", robot.scale, "true mean wheel diameter over the nominal one", "RATIO", 0.5,
             2, "");
  add_ranged(command, "--slip", robot.slip_m, "wheel slip: variance of the travel per metre, in m; 0: none",
             "M", 0, 0.01, "m");
  add_ranged(
      command, "--restart-slip", robot.restart_slip_rad,
      "unseen turn when the robot starts after a spin and a stand of 1 s or more, in the sense of the spin",
      "RAD", -0.1, 0.1, "rad");
  command
      .add_option(
          "--seed", robot.seed,
          "seed of all noise; with the path of --flash, or else of --pty, it decides the robot's unique id")
      .type_name("N")
      .capture_default_str()
      .check(console::whole(0, std::numeric_limits<std::uint64_t>::max()));
}

/// Cameras that see the robot, for this computer's programs and for the network.
void add_camera_options(console::Command command, simulation::MocapConfig& mocap) {
  command.add_option("--tracker-rate", mocap.rate_hz, "poses per second of the virtual cameras")
      .type_name("HZ")
      .capture_default_str()
      .check(console::between(1, 1000, "Hz"));
  command
      .add_option("--tracker-ahead", mocap.ahead_m,
                  "where the tracked body sits on the robot, m before its centre")
      .type_name("M")
      .capture_default_str()
      .check(console::between(-1, 1, "m"));
  command.add_option("--tracker-left", mocap.left_m, "the same, m to the left")
      .type_name("M")
      .capture_default_str()
      .check(console::between(-1, 1, "m"));
}

/// Simulated tracking software beside the robot, for clients of real tracking software.
void add_tracker_options(console::Command command, simulation::NetworkTrackerConfig& tracker) {
  command
      .add_option_function(
          "--vrpn-port",
          [&tracker](const std::vector<std::string>& words) {
            tracker.vrpn_port = static_cast<std::uint16_t>(*integer_in(words.front()));
          },
          fmt::format("also send the robot's pose by VRPN, as '{}'; usual: 3883; 0: any that is free",
                      tracker.body))
      .type_name("PORT")
      .check(console::whole(0, 65'535));
  command
      .add_option_function(
          "--natnet-port",
          [&tracker](const std::vector<std::string>& words) {
            tracker.natnet_port = static_cast<std::uint16_t>(*integer_in(words.front()));
          },
          "the same by NatNet; usual: 1510")
      .type_name("PORT")
      .check(console::whole(0, 65'535));
  command
      .add_option("--tracker-latency", tracker.faults.latency_s,
                  "of what goes to the network: from the exposure until a pose leaves, s")
      .type_name("S")
      .capture_default_str()
      .check(console::between(0, 1, "s"));
  command
      .add_option("--tracker-drops", tracker.faults.dropped,
                  "of what goes to the network: share of the poses that are lost")
      .type_name("SHARE")
      .capture_default_str()
      .check(console::between(0, 1, ""));
  command.add_flag("--tracker-for-all", tracker.everywhere,
                   "what goes to the network goes also to other computers");
}

constexpr Advice kServedRobotAdvice[] = {
    {simulation::ServerProblem::path_in_use, ": stop it or choose another --pty"},
    {simulation::ServerProblem::flash_in_use, ": stop it or choose another --flash"},
    {simulation::ServerProblem::path_taken, ": choose another path for --pty"},
    {simulation::ServerProblem::path_refused, ": choose another path for --pty"},
    {simulation::ServerProblem::path_too_long, ": choose a shorter one for --pty"},
};

}  // namespace

void prepare(SimOptions& options, std::size_t flash_bytes) {
  const simulation::NetworkTrackerConfig& tracker = options.server.tracker;
  if (options.server.fast && (tracker.vrpn_port || tracker.natnet_port))
    throw console::WrongUsage(
        "with --fast virtual time runs ahead of the clocks that a tracker's clients go by: leave it out, or "
        "--vrpn-port and --natnet-port");
  if (options.server.pty.empty()) options.server.pty = robot::make_runtime_folder() / "astro.pty";
  simulation::sweep_dead_links(robot::runtime_folder());
  options.mocap.seed = options.server.tracker.faults.seed = options.robot.seed;
  check_folder("--pty", options.server.pty);
  check_folder("--usb-pty", options.server.second_pty);
  check_flash(options.server.flash, flash_bytes);
  remove_dead_link(options.server.pty);
  remove_dead_link(options.server.second_pty);
  if (!options.server.room) return;
  options.server.scanner_pty = options.server.pty.string() + ".lidar";
  remove_dead_link(options.server.scanner_pty);
}

void serve(simulation::Server& server, const std::string& what) {
  const fs::path& pty = server.config().pty;
  const auto link = link_in_runtime_folder(pty);
  console::say(fmt::format("{} is at {}", what, pty.string()));
  for (const std::string& url : server.tracker().urls()) console::say("its pose is at " + url);
  if (server.config().room)
    console::say("its laser scanner is at lidar:" + server.config().scanner_pty.string());
  console::say(fmt::format("next: astrolabe info --port {}   (Ctrl-C here ends it)", pty.string()));
  server.run(console::interrupted);
}

void add_sim_options(console::Command command, SimOptions& options) {
  advise(kServedRobotAdvice);
  command.add_option("--pty", options.server.pty, "path to put the robot at; default: where 'ports' looks")
      .type_name("PATH");
  add_robot_options(command, options.robot);
  add_build_options(command, options.robot);
  command.add_flag("--fast", options.server.fast, "let virtual time run ahead while a host keeps up with it");
  command.add_option("--flash", options.server.flash, "file that keeps the parameters between starts")
      .type_name("FILE");
  add_camera_options(command, options.mocap);
  add_tracker_options(command, options.server.tracker);
}

}  // namespace astro::commands
