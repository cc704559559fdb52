#pragma once

#include <memory>
#include <string>

#include "host/robot/port/transport.hpp"
#include "host/simulation/robot/virtual_robot.hpp"

namespace astro::simulation {

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
