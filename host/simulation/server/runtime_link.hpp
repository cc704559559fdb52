#pragma once

#include <filesystem>

/// Where the programs of one user find the simulators of each other.
namespace astro::simulation {

/// A symlink in the runtime folder to a simulator elsewhere, for as long as the object lives; none if the
/// simulator is in that folder anyway or all names are in use. Other programs find the simulator by it.
class RuntimeLink {
 public:
  RuntimeLink(const std::filesystem::path& folder, const std::filesystem::path& pty);
  ~RuntimeLink();
  RuntimeLink(const RuntimeLink&) = delete;
  RuntimeLink& operator=(const RuntimeLink&) = delete;

 private:
  std::filesystem::path target_;
  std::filesystem::path link_;  // empty: none
};

}  // namespace astro::simulation
