#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/base/descriptor.hpp"
#include "host/recording/run.hpp"

namespace astro::simulation {

/// The connection of the virtual cameras to a host: a Unix socket beside the robot's pty, which only programs
/// of this machine can reach. Text, one line per sample, after a line that names the format
/// (host/truth/live/socket_source.hpp reads it):
///
///   astrolabe-mocap 1
///   TIME_US X_M Y_M THETA_RAD VALID
class TruthServer {
 public:
  /// Throws astro::Error if the socket cannot be made at `path`.
  explicit TruthServer(std::filesystem::path path);
  ~TruthServer();
  TruthServer(const TruthServer&) = delete;
  TruthServer& operator=(const TruthServer&) = delete;

  /// Adds a link to the same socket; the destructor removes it. Throws astro::Error if it cannot be created.
  void add_link(const std::filesystem::path& link);

  void accept_clients();
  void send(const recording::TruthSample& sample);

  /// Tries to send what is waiting; returns true if some client has not taken all yet. A client that falls
  /// more than a few megabytes behind is disconnected.
  bool flush();

 private:
  struct Client {
    Descriptor socket;
    std::string waiting;
  };

  std::filesystem::path path_;
  std::vector<std::filesystem::path> links_;
  Descriptor listener_;
  std::vector<Client> clients_;
};

}  // namespace astro::simulation
