#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace astro::sim {

/// A bounded queue of bytes: bytes that do not fit are not taken.
class ByteQueue {
 public:
  static constexpr std::size_t kCapacity = 8192;

  std::size_t size() const { return written_ - read_; }
  std::size_t room() const { return kCapacity - size(); }

  std::size_t push(std::span<const std::uint8_t> bytes) {
    const std::size_t count = std::min(bytes.size(), room());
    for (std::size_t i = 0; i < count; ++i) ring_[(written_ + i) % kCapacity] = bytes[i];
    written_ += count;
    return count;
  }

  std::size_t pop(std::span<std::uint8_t> into) {
    const std::size_t count = std::min(into.size(), size());
    for (std::size_t i = 0; i < count; ++i) into[i] = ring_[(read_ + i) % kCapacity];
    read_ += count;
    return count;
  }

  void clear() { read_ = written_; }

 private:
  std::array<std::uint8_t, kCapacity> ring_{};
  std::size_t read_ = 0, written_ = 0;  // running totals; kCapacity divides 2^64
};

/// The serial ports: the robot's end for the firmware, the host's end for the owner of the board.
class Ports {
 public:
  static constexpr int kPorts = 2;

  std::size_t read(int port, std::span<std::uint8_t> into) noexcept { return lane(port).to_robot.pop(into); }
  std::size_t write(int port, std::span<const std::uint8_t> bytes) noexcept {
    return lane(port).to_host.push(bytes);
  }
  std::size_t room(int port) noexcept { return lane(port).to_host.room(); }

  /// Each returns how many bytes it moved; none blocks.
  std::size_t host_write(int port, std::span<const std::uint8_t> bytes) {
    return lane(port).to_robot.push(bytes);
  }
  std::size_t host_read(int port, std::span<std::uint8_t> into) { return lane(port).to_host.pop(into); }
  std::size_t host_room(int port) const { return lanes_[static_cast<std::size_t>(port)].to_robot.room(); }

  /// Drops all bytes that have not been read, as when the robot restarts.
  void clear() {
    for (Lane& lane : lanes_) {
      lane.to_robot.clear();
      lane.to_host.clear();
    }
  }

 private:
  struct Lane {
    ByteQueue to_robot, to_host;
  };
  Lane& lane(int port) { return lanes_[static_cast<std::size_t>(port)]; }

  std::array<Lane, kPorts> lanes_;
};

}  // namespace astro::sim
