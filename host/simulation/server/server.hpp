#pragma once

#include <poll.h>

#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "host/simulation/robot/robot_options.hpp"
#include "host/simulation/robot/virtual_robot.hpp"
#include "host/simulation/server/network_tracker.hpp"
#include "host/simulation/server/pace.hpp"
#include "host/simulation/server/path_claim.hpp"
#include "host/simulation/server/pty.hpp"
#include "host/simulation/server/served_robot.hpp"
#include "host/simulation/server/truth_server.hpp"

namespace astro::simulation {

struct ServerConfig {
  // Symlink to create, which leads to the robot's port 0; the cameras' socket is beside it, with ".mocap"
  // added.
  std::filesystem::path pty;
  // File that keeps the robot's flash between starts; written before a host hears that data was stored.
  // Empty: nothing is kept.
  std::filesystem::path flash{};
  bool fast = false;
  std::filesystem::path second_pty{};  // to port 1; empty: none
  NetworkTrackerConfig tracker{};      // by which protocols trackers of the network send the robot's pose
};

/// The content of a flash file; empty if there is none. Throws astro::Error if it cannot be read.
std::vector<std::uint8_t> load_flash(const std::filesystem::path& path);

/// The robot as this server starts it: its flash holds load_flash(server.flash), and its serial number is the
/// same at every start and another one for each robot, because it follows from where the robot keeps its
/// parameters, or else from where it is. Throws as config_of(robot) and load_flash().
sim::Config config_of(const RobotOptions& robot, const ServerConfig& server);

/// One port of a robot at one pty. The pty exists while the robot's port does.
class Channel {
 public:
  /// Errors as Pty.
  Channel(ServedRobot& robot, int port, std::filesystem::path link);

  /// Passes bytes from the host to the robot; returns false if there were none.
  bool receive();
  /// Passes bytes from the robot to the host; returns true if some are left because the host has not taken
  /// them.
  bool transmit();
  /// Follows changes: the robot's port appears or disappears, a program opens or closes the pty.
  void update_connection();

  bool connected() const { return connected_; }
  /// For poll(), while connected.
  pollfd waits_for() const;

 private:
  ServedRobot& robot_;
  int port_;
  std::filesystem::path link_;
  std::optional<Pty> pty_;
  bool connected_ = false;
  std::vector<std::uint8_t> outgoing_;
};

/// A simulated robot behind a pty, for as long as the process lives.
///
/// Real time: one virtual millisecond per real millisecond; while the robot drives, time waits for a driver that is late, as in
/// fast motion. Fast: virtual time runs ahead as long as a host
/// sends something at least every 100 virtual ms, or 70 while the robot drives (its client pings by the robot's clock), or 30 while
/// a host regulates the motors' voltages, and reads
/// what it is sent; else it waits for the host, and after ten seconds falls back to real time, so that the robot's command time-out
/// still notices a host that hangs. One that has gone is not waited for.
class Server {
 public:
  /// A VirtualRobot. Throws astro::Error if a pty, the file of the flash or a port cannot be used.
  Server(const sim::Config& robot, const MocapConfig& mocap, const ServerConfig& config);
  /// The same of config_of(robot, config).
  Server(const RobotOptions& robot, const MocapConfig& mocap, const ServerConfig& config);
  /// Another robot, whose flash holds load_flash(config.flash) already. Throws the same.
  Server(std::unique_ptr<ServedRobot> robot, const ServerConfig& config);
  ~Server();

  /// Runs until `stop` returns true; it is called at least every 20 ms.
  void run(const std::function<bool()>& stop);

  const ServerConfig& config() const { return config_; }
  const NetworkTracker& tracker() const { return tracker_; }

 private:
  using Clock = std::chrono::steady_clock;

  void receive();
  /// True if the host has not taken all bytes yet.
  bool transmit();
  bool connected() const;
  bool host_is_late();
  void wait_for_host();
  bool runs_ahead(bool host_is_behind);
  void step();
  void wait();
  void claim_flash();  // throws if it cannot be kept, or is that of another simulator
  void save_flash();

  ServerConfig config_;
  std::unique_ptr<ServedRobot> robot_;
  std::deque<Channel> channels_;
  NetworkTracker tracker_;
  std::optional<TruthServer> truth_;  // after the ptys, whose links show that the paths are free
  std::uint64_t last_heard_us_ = 0;   // virtual
  int turns_waited_ = 0;              // since a host was heard, and took what it was sent
  Clock::time_point turn_at_{};       // when the last of these turns was
  Pace pace_;
  std::vector<std::uint8_t> saved_flash_;
  std::optional<PathClaim> flash_claim_;  // two robots would take each other's parameters for their own
};

}  // namespace astro::simulation
