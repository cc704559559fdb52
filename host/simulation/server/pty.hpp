#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "host/base/descriptor.hpp"
#include "host/simulation/server/path_claim.hpp"

namespace astro::simulation {

/// Why a simulator cannot serve at a path. Value: the path. The last two are about the file of its flash.
enum class ServerProblem {
  path_in_use,
  path_taken,
  path_refused,
  path_too_long,
  flash_is_link,
  flash_in_use
};

/// The robot's end of a pseudo terminal, and a symlink by which hosts find the other end. The terminal is raw
/// from the start, so nothing is echoed or translated, whoever opens it.
///
/// The symlink leads to a descriptor of this process, /proc/PID/fd/N, and not to /dev/pts/N, because another
/// simulator's terminal may soon have that number. If the process is killed, its link leads nowhere.
class Pty {
 public:
  /// Throws astro::Error if `link` exists and is no symlink of a simulator that has ended, or cannot be
  /// created.
  explicit Pty(const std::filesystem::path& link);
  ~Pty();
  Pty(const Pty&) = delete;
  Pty& operator=(const Pty&) = delete;

  /// Adds another link to the same terminal; the destructor removes it.
  void add_link(const std::filesystem::path& link);

  int fd() const { return master_.get(); }
  const std::filesystem::path& link() const { return links_.front(); }

  /// True while a host has the other end open.
  bool connected() const;

  /// The speed that a host has set, reduced to what matters here: 134 baud, or 115200 for all others.
  std::uint32_t baud() const;

  /// Return the number of bytes moved, maybe 0; never block.
  std::size_t read(std::span<std::uint8_t> into);
  std::size_t write(std::span<const std::uint8_t> bytes);

 private:
  Descriptor master_;
  Descriptor reference_;          // refers to the hosts' end
  std::filesystem::path target_;  // of the links
  std::vector<std::filesystem::path> links_;
  std::vector<PathClaim> claims_;  // of the links
};

/// Removes what killed simulators have left in `folder`: links NAME.pty that no running simulator has
/// claimed, and the sockets NAME.pty.mocap beside them. Changes nothing else.
void sweep_dead_links(const std::filesystem::path& folder);

/// A symlink in the runtime folder to a simulator elsewhere, by which other programs find the simulator. It
/// exists for as long as the object lives. There is none if the simulator is in that folder anyway or all
/// names are in use.
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
