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
#include "host/simulation/room/room_file.hpp"
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
  std::filesystem::path second_pty{};   // to port 1; empty: none
  NetworkTrackerConfig tracker{};       // by which protocols trackers of the network send the robot's pose
  std::optional<RoomFile> room{};       // what the robot's laser scanner sees; none: it has no scanner
  std::filesystem::path scanner_pty{};  // to the scanner, an RPLIDAR A1, if there is a room
};

/// The content of a flash file; empty if there is none. Throws astro::Error if it cannot be read.
std::vector<std::uint8_t> load_flash(const std::filesystem::path& path);

/// The robot as this server starts it. Its flash holds load_flash(server.flash). Its serial number is the
/// same at every start and differs between robots, because it is a hash of the flash file's path, or of the
/// pty's path if there is no flash file. Throws as config_of(robot) and load_flash().
sim::Config config_of(const RobotOptions& robot, const ServerConfig& server);

/// One port of a robot at one pty. The pty exists while the robot's port does.
class Channel {
 public:
  /// Errors as Pty.
  Channel(ServedRobot& robot, int port, std::filesystem::path link);

  /// Passes bytes from the host to the robot; returns false if there were none.
  bool receive();
  /// Passes bytes from the robot to the host; returns true if some remain because the host has not taken
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
/// Real time: one virtual millisecond per real millisecond. If the robot drives and its driver is late,
/// virtual time waits for the driver, as in fast motion.
///
/// Fast motion: virtual time runs ahead as long as a host reads what it is sent, and sends something at least
/// every 100 virtual ms (70 while the robot drives, because its client pings by the robot's clock; 30 while a
/// host regulates the motors' voltages). Otherwise virtual time waits for the host. After ten seconds it
/// falls back to real time, so that the robot's command time-out still notices a host that hangs. Time does
/// not wait for a host that has disconnected.
class Server {
 public:
  /// Serves a VirtualRobot. Throws astro::Error if a pty, the file of the flash or a port cannot be used.
  Server(const sim::Config& robot, const MocapConfig& mocap, const ServerConfig& config);
  /// The same with config_of(robot, config).
  Server(const RobotOptions& robot, const MocapConfig& mocap, const ServerConfig& config);
  /// Serves another robot, whose flash must already hold load_flash(config.flash). Throws the same.
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
  void claim_flash();  // throws if the file cannot be written, or is in use by another simulator
  void save_flash();

  ServerConfig config_;
  std::unique_ptr<ServedRobot> robot_;
  std::deque<Channel> channels_;
  NetworkTracker tracker_;
  std::optional<TruthServer> truth_;  // created after the ptys, whose links show that the paths are free
  std::uint64_t last_heard_us_ = 0;   // virtual
  int turns_waited_ = 0;              // since a host sent something, and took what it was sent
  Clock::time_point turn_at_{};       // when the last of these turns was
  Pace pace_;
  std::vector<std::uint8_t> saved_flash_;
  std::optional<PathClaim> flash_claim_;  // so that no two robots use the same parameters
};

}  // namespace astro::simulation
