#pragma once

#include <filesystem>
#include <optional>
#include <utility>

#include "host/base/descriptor.hpp"

namespace astro::simulation {

/// Marks a path as in use for the other simulators on this computer: the path of a link, or of the file of a
/// robot's flash. The mark is the name of an abstract socket, which belongs to one process and disappears
/// with it, however the process ends.
class PathClaim {
 public:
  /// Nothing if another process has claimed the path. Throws astro::Error if this cannot be determined.
  static std::optional<PathClaim> of(const std::filesystem::path& path);

 private:
  explicit PathClaim(Descriptor socket) : socket_(std::move(socket)) {}

  Descriptor socket_;
};

}  // namespace astro::simulation
