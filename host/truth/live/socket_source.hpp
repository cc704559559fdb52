#pragma once

#include <filesystem>
#include <string>

#include "host/base/descriptor.hpp"
#include "host/truth/source/source.hpp"

namespace astro::truth {

/// What is wrong with the cameras. The value is the path of their socket.
enum class SocketProblem { not_served, disconnected, of_other_version, no_pose };

/// The virtual cameras of a simulator in another process (host/simulation/server/truth_server.hpp has the
/// format).
class SocketSource : public Source {
 public:
  /// Throws astro::Error with SocketProblem::not_served if nobody serves there.
  explicit SocketSource(const std::filesystem::path& path);

  std::vector<recording::TruthSample> poll() override;
  std::string name() const override { return "sim"; }
  std::string clock() const override { return "robot"; }

 private:
  recording::TruthSample parse(std::string_view line) const;
  [[noreturn]] void fail_line() const;

  std::filesystem::path path_;
  Descriptor socket_;
  bool greeted_ = false;
  std::string pending_;  // an incomplete line
};

/// Where the simulator behind `port` (a path, perhaps a symlink to its pty) serves its cameras.
std::filesystem::path mocap_socket_of(const std::filesystem::path& port);

}  // namespace astro::truth
