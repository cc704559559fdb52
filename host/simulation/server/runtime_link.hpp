#pragma once

#include <filesystem>

/// Where the programs of one user find each other's simulators.
namespace astro::simulation {

/// A symlink in the runtime folder to a simulator elsewhere, for as long as it lives; none if the simulator
/// is in that folder anyway or all names for it are taken. `ports` finds the simulator by it.
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
