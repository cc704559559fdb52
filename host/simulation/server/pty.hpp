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
  /// Throws astro::Error if `link` exists and is no symlink left behind by another simulator, or cannot be
  /// made.
  explicit Pty(std::filesystem::path link);
  ~Pty();
  Pty(const Pty&) = delete;
  Pty& operator=(const Pty&) = delete;

  /// Another name for the same terminal, taken away with it.
  void add_link(const std::filesystem::path& link);

  int fd() const { return fd_; }
  const std::filesystem::path& link() const { return links_.front(); }

  /// True while a host has the other end open.
  bool connected() const;

  /// The speed that a host has set, as far as it means something here: 134, or 115200 for all others.
  std::uint32_t baud() const;

  /// Bytes moved, 0 if none could be; never block.
  std::size_t read(std::span<std::uint8_t> into);
  std::size_t write(std::span<const std::uint8_t> bytes);

 private:
  int fd_ = -1;
  std::filesystem::path device_;
  std::vector<std::filesystem::path> links_;
  std::vector<int> claims_;  // sockets whose names say that the links are taken
};

/// Removes what simulators that were killed have left in `folder`: links NAME.pty that no living simulator
/// has claimed and the sockets NAME.pty.mocap beside them. Touches nothing else.
void sweep_dead_links(const std::filesystem::path& folder);

}  // namespace astro::simulation
