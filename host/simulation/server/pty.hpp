#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace astro::simulation {

/// The robot's end of a pseudo terminal, and a symlink by which hosts find the other end. Raw from the start:
/// nothing is echoed or translated, whoever opens it.
class Pty {
 public:
  /// Throws astro::Error if `link` exists and is no symlink of a simulator that has ended, or cannot be
  /// created.
  explicit Pty(std::filesystem::path link);
  ~Pty();
  Pty(const Pty&) = delete;
  Pty& operator=(const Pty&) = delete;

  /// Adds another link to the same terminal; the destructor removes it.
  void add_link(const std::filesystem::path& link);

  int fd() const { return fd_; }
  const std::filesystem::path& link() const { return links_.front(); }

  /// True while a host has the other end open.
  bool connected() const;

  /// The speed that a host has set, reduced to what matters here: 134 baud, or 115200 for all others.
  std::uint32_t baud() const;

  /// Return the number of bytes moved, maybe 0; never block.
  std::size_t read(std::span<std::uint8_t> into);
  std::size_t write(std::span<const std::uint8_t> bytes);

 private:
  int fd_ = -1;
  std::filesystem::path device_;
  std::vector<std::filesystem::path> links_;
  std::vector<int> claims_;  // sockets whose names show that the links are in use
};

/// Removes what killed simulators have left in `folder`: links NAME.pty that no running simulator has
/// claimed, and the sockets NAME.pty.mocap beside them. Changes nothing else.
void sweep_dead_links(const std::filesystem::path& folder);

}  // namespace astro::simulation
