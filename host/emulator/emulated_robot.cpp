#include "host/emulator/emulated_robot.hpp"

#include <algorithm>
#include <utility>

namespace astro::emulator {

using namespace std::chrono_literals;

void EmulatedRobot::step() {
  teensy_.run_for(200us);
  const auto bytes = teensy_.serial().receive();
  received_.insert(received_.end(), bytes.begin(), bytes.end());
  const std::uint64_t clock_us = teensy_.robot_clock_us();
  if (clock_us < clock_us_) mocap_.restart_clock();  // the chip has started again
  clock_us_ = clock_us;
  if (const auto sample = mocap_.advance(clock_us, teensy_.world().truth())) seen_.push_back(*sample);
}

std::size_t EmulatedRobot::read_serial(std::span<std::uint8_t> into) {
  const std::size_t count = std::min(into.size(), received_.size());
  std::copy_n(received_.begin(), count, into.begin());
  received_.erase(received_.begin(), received_.begin() + static_cast<std::ptrdiff_t>(count));
  return count;
}

std::size_t SerialTransport::read(std::span<std::uint8_t> into, link::microseconds timeout) {
  const link::microseconds deadline = now() + timeout;
  while (true) {
    const std::size_t count = robot_->read_serial(into);
    if (count != 0 || now() >= deadline) return count;
    robot_->step();
  }
}

link::microseconds SerialTransport::now() const {
  return link::microseconds(static_cast<std::int64_t>(robot_->teensy().now_us()));
}

void SerialTransport::reopen(link::microseconds) {
  std::array<std::uint8_t, 256> stale{};
  while (robot_->read_serial(stale) != 0) {
  }
}

}  // namespace astro::emulator
