#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "host/robot/client/client.hpp"
#include "host/robot/motion/paths.hpp"
#include "host/simulation/robot/in_process.hpp"
#include "tests/support/robots/drive_of.hpp"

/// The firmware on the simulated board and a host's client, in virtual time, for tests of what the robot
/// does.
namespace astro::support {

class RobotOnBench : public testing::Test {
 protected:
  using Bridge = sim::Bridge;

  explicit RobotOnBench(const sim::Config& config = quiet())
      : robot_(std::make_shared<simulation::VirtualRobot>(config, simulation::MocapConfig{})),
        client_(std::make_unique<simulation::InProcessTransport>(robot_)) {
    client_.connect();
    run_ms(50);  // through boot
  }

  static sim::Config quiet() {
    sim::Config config;
    config.slip_m = 0;
    return config;
  }

  template <class Message>
  typename Message::Reply ask(const Message& message) {
    return client_.request(message);
  }
  /// The robot's refusal of a request; fails the test if the robot does not refuse.
  template <class Message>
  robot::RobotRefused refusal(const Message& message) {
    try {
      client_.request(message);
    } catch (const robot::RobotRefused& refused) {
      return refused;
    }
    ADD_FAILURE() << Message::kName << " was not refused";
    return {"", protocol::ErrorCode::unsupported, 0};
  }

  /// Time passes while the host is silent.
  void silence_ms(int ms) {
    for (int i = 0; i < ms; ++i) robot_->step();
  }
  /// Time passes while the host keeps the drive alive.
  void run_ms(int ms) { client_.pump(std::chrono::milliseconds(ms)); }

  protocol::Mode mode() { return drive().mode(); }
  const Drive& drive() { return drive_of(*robot_); }
  sim::Board& board() { return robot_->board(); }
  bool powered() { return board().motors().state() == Bridge::drive; }
  bool open() { return board().motors().state() == Bridge::coast; }

  std::shared_ptr<simulation::VirtualRobot> robot_;
  robot::Client client_;
};

}  // namespace astro::support
