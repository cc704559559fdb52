#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

namespace astro::mock {

/// Serial ports with a queue of bytes in each direction. A test fills `to_robot`, takes from `to_host`, and
/// chooses the room that a slow host leaves.
struct Ports {
  static constexpr int kPorts = 2;

  struct Lane {
    std::deque<std::uint8_t> to_robot;
    std::vector<std::uint8_t> to_host;
    std::size_t capacity = 1024;  // of to_host
  };
  std::array<Lane, kPorts> lanes;

  std::size_t read(int port, std::span<std::uint8_t> into) noexcept {
    std::deque<std::uint8_t>& waiting = lane(port).to_robot;
    const std::size_t count = std::min(into.size(), waiting.size());
    const auto end = waiting.begin() + static_cast<std::ptrdiff_t>(count);
    std::copy(waiting.begin(), end, into.begin());
    waiting.erase(waiting.begin(), end);
    return count;
  }

  std::size_t write(int port, std::span<const std::uint8_t> bytes) noexcept {
    const auto taken = bytes.first(std::min(bytes.size(), room(port)));
    lane(port).to_host.insert(lane(port).to_host.end(), taken.begin(), taken.end());
    return taken.size();
  }

  std::size_t room(int port) noexcept {
    return lane(port).capacity - std::min(lane(port).capacity, lane(port).to_host.size());
  }

  Lane& lane(int port) { return lanes.at(static_cast<std::size_t>(port)); }
};

}  // namespace astro::mock
