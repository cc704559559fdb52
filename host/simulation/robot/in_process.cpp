#include "host/simulation/robot/in_process.hpp"

#include <utility>

namespace astro::simulation {

InProcessTransport::InProcessTransport(std::shared_ptr<VirtualRobot> robot, int port)
    : robot_(std::move(robot)), port_(port) {}

void InProcessTransport::write(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    bytes = bytes.subspan(robot_->board().ports().host_write(port_, bytes));
    if (!bytes.empty()) robot_->step();
  }
}

std::size_t InProcessTransport::read(std::span<std::uint8_t> into, microseconds timeout) {
  const microseconds deadline = now() + timeout;
  while (true) {
    const std::size_t count = robot_->board().ports().host_read(port_, into);
    if (count != 0 || now() >= deadline) return count;
    robot_->step();
  }
}

microseconds InProcessTransport::now() const {
  return microseconds(static_cast<std::int64_t>(robot_->board().world_us()));
}

void InProcessTransport::reopen(microseconds) {
  std::array<std::uint8_t, 256> stale;
  while (robot_->board().ports().host_read(port_, stale) != 0) {
  }
}

}  // namespace astro::simulation
