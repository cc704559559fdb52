#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "host/simulation/server/channel.hpp"
#include "host/simulation/server/pace.hpp"
#include "host/simulation/server/served.hpp"
#include "host/simulation/server/truth_server.hpp"
#include "host/simulation/robot/virtual_robot.hpp"

namespace astro::simulation {

struct ServerConfig {
  // Symlink to make, which leads to the robot's port 0; the cameras' socket is beside it, with ".mocap"
  // added.
  std::filesystem::path pty;
  // Keeps the robot's flash between starts, on the disk before a host hears that it is kept; empty: nothing
  // is kept.
  std::filesystem::path flash{};
  bool fast = false;
  std::filesystem::path second_pty{};  // to port 1; empty: none
};

/// The content of a flash file; empty if there is none. Throws astro::Error if it cannot be read.
std::vector<std::uint8_t> load_flash(const std::filesystem::path& path);

/// A simulated robot behind a pty, for as long as the process lives.
///
/// Real time: one virtual millisecond each real one. Fast: virtual time runs ahead as long as a host says
/// something at least every 100 virtual ms (its client pings by the robot's clock) and takes what it is sent;
/// otherwise it falls back to real time, so a host that dies is still noticed by the robot's own command
/// timeout.
class Server {
 public:
  Server(const sim::Config& robot, const MocapConfig& mocap, const ServerConfig& config);
  /// Throws astro::Error if a pty or the flash's file cannot be had.
  /// Another robot than VirtualRobot, which has been given load_flash(config.flash).
  Server(std::unique_ptr<Served> robot, const ServerConfig& config);
  ~Server();

  /// Until `stop` says so; asked at least every 20 ms.
  void run(const std::function<bool()>& stop);

  const ServerConfig& config() const { return config_; }

 private:
  using Clock = std::chrono::steady_clock;

  void receive();
  /// True if the host has not taken all bytes yet.
  bool transmit();
  bool connected() const;
  bool runs_ahead(bool host_is_behind);
  void step();
  void wait();
  void check_flash_can_be_kept() const;
  void save_flash();

  ServerConfig config_;
  std::unique_ptr<Served> robot_;
  std::deque<Channel> channels_;
  std::optional<TruthServer> truth_;  // after the ptys, which say whether the paths are free
  std::uint64_t last_heard_us_ = 0;   // virtual
  Clock::time_point heard_at_{};      // the same in real time
  Clock::time_point behind_since_{};  // real time since when the host takes nothing
  Pace pace_;
  std::vector<std::uint8_t> saved_flash_;
};

}  // namespace astro::simulation
