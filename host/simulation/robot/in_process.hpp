#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "host/robot/port/transport.hpp"
#include "host/simulation/robot/virtual_robot.hpp"
#include "host/truth/source/source.hpp"

namespace astro::simulation {

/// The virtual cameras that watch a robot of this process, simulated or emulated, as a source of ground truth.
class CameraTruth : public truth::Source {
 public:
  /// `robot` has take_truth(), what its cameras saw since the last call.
  template <class Robot>
  explicit CameraTruth(std::shared_ptr<Robot> robot)
      : take_([robot = std::move(robot)] { return robot->take_truth(); }) {}

  std::vector<recording::TruthSample> poll() override { return take_(); }
  std::string name() const override { return "sim"; }
  std::string clock() const override { return "robot"; }

 private:
  std::function<std::vector<recording::TruthSample>()> take_;
};

/// The laser scanner of a robot of this process.
class ScannerTruth : public truth::Source {
 public:
  /// Precondition: the robot has a scanner.
  explicit ScannerTruth(std::shared_ptr<VirtualRobot> robot) : robot_(std::move(robot)) {}

  std::vector<recording::TruthSample> poll() override { return {}; }
  std::vector<lidar::Scan> take_scans() override { return robot_->scanner()->take_scans(); }
  std::string name() const override { return "lidar"; }
  std::string clock() const override { return "robot"; }

 private:
  std::shared_ptr<VirtualRobot> robot_;
};

/// A link to a simulated robot in the same process. Virtual time passes only while the host waits for a byte,
/// so a whole experiment runs as fast as it computes, and always in the same way.
class InProcessTransport : public robot::Transport {
 public:
  explicit InProcessTransport(std::shared_ptr<VirtualRobot> robot, int port = 0);

  void write(std::span<const std::uint8_t> bytes) override;
  std::size_t read(std::span<std::uint8_t> into, microseconds timeout) override;
  microseconds now() const override;
  void reopen(microseconds timeout) override;
  const std::string& name() const override { return name_; }

 private:
  std::shared_ptr<VirtualRobot> robot_;
  int port_;
  std::string name_ = "the simulated robot in this process";
};

}  // namespace astro::simulation
