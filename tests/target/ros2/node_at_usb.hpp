#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/emulator/robot/emulated_robot.hpp"
#include "host/formats/messages/geometry.hpp"
#include "host/formats/messages/nodes.hpp"
#include "host/formats/messages/std.hpp"
#include "host/live/driver/driver.hpp"
#include "tests/support/ros2/fake_middleware.hpp"
#include "tests/target/firmware_file.hpp"

namespace astro::ros2 {

using std::chrono::milliseconds;

/// An emulated Teensy on a robot, and the node's driver at its USB port.
class NodeAtUsb : public testing::Test {
 protected:
  NodeAtUsb() {
    live::DriverOptions options;
    options.cmd_vel_type = live::CommandType::twist;
    options.clock = {[this] { return now(); },
                     [this] { return 1'790'000'000'000'000'000 + now().count() * 1000; }};
    ros_.on_wait = [this](microseconds most) { silence_ms(static_cast<int>(most.count() / 1000)); };
    driver_.emplace(
        std::vector<live::Middleware*>{&ros_}, [this] { return open(); }, std::move(options));
  }

  microseconds now() const { return microseconds(static_cast<std::int64_t>(robot_->teensy().now_us())); }
  void silence_ms(int ms) {
    for (int i = 0; i < 5 * ms; ++i) robot_->step();
  }
  void run_ms(int ms) {
    const microseconds until = now() + milliseconds(ms);
    while (now() < until) driver_->step();
  }
  template <class Condition>
  bool run_until(Condition condition, int limit_ms) {
    const microseconds until = now() + milliseconds(limit_ms);
    while (now() < until) {
      if (condition()) return true;
      driver_->step();
    }
    return false;
  }
  void drive_ms(int ms, double v_mps, double omega_radps) {
    msg::Twist twist;
    twist.linear.x = v_mps;
    twist.angular.z = omega_radps;
    for (int i = 0; i < ms; i += 50) {
      ros_.say("/cmd_vel", twist);
      run_ms(50);
    }
  }
  bool call(const char* service) { return ros_.call<msg::Trigger>(service).success; }
  bool arm() { return call("/arm"); }
  bool outputs_off() {
    const auto bridges = robot_->teensy().world().bridges();
    return bridges.open[0] && bridges.open[1];
  }
  std::vector<msg::Odometry> odometry() { return ros_.take<msg::Odometry>("/odom"); }
  double off_m(const msg::Odometry& said) {
    const sim::Pose truth = robot_->teensy().world().truth();
    return std::hypot(said.pose.pose.position.x - truth.x_m, said.pose.pose.position.y - truth.y_m);
  }

  std::string why_silent() {
    std::string all;
    for (const auto& status : ros_.newest<msg::DiagnosticArray>("/diagnostics").status)
      all += status.name + ": " + status.message + "\n";
    return all;
  }

  emulator::UsbController& cable() { return robot_->teensy().usb(); }
  emulator::Teensy& teensy() { return robot_->teensy(); }
  std::unique_ptr<robot::Transport> serial_line() const {
    return std::make_unique<emulator::PortTransport>(robot_, emulator::Port::serial);
  }

 private:
  std::unique_ptr<robot::Transport> open() {
    if (!robot_->usb().present()) throw Error("there is no port");
    return std::make_unique<emulator::PortTransport>(robot_, emulator::Port::usb);
  }
  static sim::Config quiet() {
    sim::Config config;
    config.slip_m = 0;
    return config;
  }

  std::shared_ptr<emulator::EmulatedRobot> robot_ =
      std::make_shared<emulator::EmulatedRobot>(target::kImage, quiet(), simulation::MocapConfig{});
  test::FakeMiddleware ros_;
  std::optional<live::Driver> driver_;
};

}  // namespace astro::ros2
