#pragma once

#include <memory>
#include <string>

#include "host/robot/port/transport.hpp"
#include "host/simulation/robot/virtual_robot.hpp"
#include "host/truth/source/source.hpp"

namespace astro::simulation {

/// A link to a simulated robot in the same process. Virtual time passes only while the host waits for a byte,
/// so a whole experiment runs as fast as it computes, and always in the same way.
class InProcessTransport : public robot::Transport {
 public:
  explicit InProcessTransport(std::shared_ptr<VirtualRobot> robot, int port = 0);

  void write(std::span<const std::uint8_t> bytes) override;
  std::size_t read(std::span<std::uint8_t> into, robot::microseconds timeout) override;
  robot::microseconds now() const override;
  void reopen(robot::microseconds timeout) override;
  const std::string& name() const override { return name_; }

 private:
  std::shared_ptr<VirtualRobot> robot_;
  int port_;
  std::string name_ = "the simulated robot in this process";
};

/// The virtual cameras of the same robot.
class InProcessTruth : public truth::Source {
 public:
  explicit InProcessTruth(std::shared_ptr<VirtualRobot> robot) : robot_(std::move(robot)) {}

  std::vector<recording::TruthSample> poll() override { return robot_->take_truth(); }
  std::string name() const override { return "sim"; }
  std::string clock() const override { return "robot"; }

 private:
  std::shared_ptr<VirtualRobot> robot_;
};

}  // namespace astro::simulation
