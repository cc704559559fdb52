#pragma once

#include <filesystem>
#include <optional>
#include <utility>

#include "host/base/descriptor.hpp"

namespace astro::simulation {

/// Shows the other simulators of this computer that a path is in use: that of a link, or the file of a robot's flash. It is the name
/// of an abstract socket, which belongs to one process and ends with it, however it ends.
class PathClaim {
 public:
  /// Nothing if another process has claimed the path. Throws astro::Error if it cannot be known.
  static std::optional<PathClaim> of(const std::filesystem::path& path);

 private:
  explicit PathClaim(Descriptor socket) : socket_(std::move(socket)) {}

  Descriptor socket_;
};

}  // namespace astro::simulation
