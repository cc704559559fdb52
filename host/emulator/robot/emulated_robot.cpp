#include "host/emulator/robot/emulated_robot.hpp"

#include <algorithm>
#include <utility>

namespace astro::emulator {

using namespace std::chrono_literals;

void EmulatedRobot::step() {
  teensy_.run_for(200us);
  usb_.step();
  const auto collect = [this](Port port, std::vector<std::uint8_t> bytes) {
    received(port).insert(received(port).end(), bytes.begin(), bytes.end());
  };
  collect(Port::serial, teensy_.serial().receive());
  collect(Port::usb, usb_.receive());
  const std::uint64_t clock_us = teensy_.robot_clock_us();
  if (clock_us < clock_us_) mocap_.restart_clock();  // the chip has started again
  clock_us_ = clock_us;
  if (const auto sample = mocap_.advance(clock_us, teensy_.world().truth())) seen_.push_back(*sample);
}

void EmulatedRobot::send(Port port, std::span<const std::uint8_t> bytes) {
  if (port == Port::usb)
    usb_.send(bytes);
  else
    teensy_.serial().send(bytes);
}

std::size_t EmulatedRobot::underway(Port port) {
  return port == Port::usb ? usb_.underway() : teensy_.serial().underway();
}

std::size_t EmulatedRobot::receive(Port port, std::span<std::uint8_t> into) {
  std::vector<std::uint8_t>& bytes = received(port);
  const std::size_t count = std::min(into.size(), bytes.size());
  std::copy_n(bytes.begin(), count, into.begin());
  bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count));
  return count;
}

PortTransport::PortTransport(std::shared_ptr<EmulatedRobot> robot, Port port)
    : robot_(std::move(robot)),
      port_(port),
      name_(port == Port::usb ? "the emulated robot's USB port" : "the emulated robot's serial port") {
  if (port_ == Port::serial) return;
  robot_->usb().open(115'200);  // which has no meaning for a USB port
  reopen(std::chrono::seconds(1));
}

PortTransport::~PortTransport() {
  if (port_ == Port::usb) robot_->usb().close();
}

void PortTransport::check_present() const {
  if (!present()) throw robot::LinkLost(name_ + " has gone");
}

void PortTransport::write(std::span<const std::uint8_t> bytes) {
  check_present();
  robot_->send(port_, bytes);
}

std::size_t PortTransport::read(std::span<std::uint8_t> into, microseconds timeout) {
  const microseconds deadline = now() + timeout;
  while (true) {
    const std::size_t count = robot_->receive(port_, into);
    if (count != 0 || now() >= deadline) return count;
    check_present();
    robot_->step();
  }
}

microseconds PortTransport::now() const {
  return microseconds(static_cast<std::int64_t>(robot_->teensy().now_us()));
}

void PortTransport::reopen(microseconds timeout) {
  const microseconds deadline = now() + timeout;
  while (!present()) {
    if (now() >= deadline) throw Error(name_ + " does not come back");
    robot_->step();
  }
  std::array<std::uint8_t, 256> stale{};
  while (robot_->receive(port_, stale) != 0) {
  }
}

}  // namespace astro::emulator
