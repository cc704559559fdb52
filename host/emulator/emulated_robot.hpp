#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "host/emulator/teensy.hpp"
#include "host/link/transport.hpp"
#include "host/simulator/virtual_mocap.hpp"
#include "host/truth/source.hpp"

namespace astro::emulator {

/// An emulated Teensy on its robot, watched by the virtual cameras.
class EmulatedRobot {
 public:
  EmulatedRobot(const std::filesystem::path& hex, const sim::Config& config,
                const simulator::MocapConfig& mocap)
      : teensy_(hex, config), mocap_(mocap) {}

  /// A fifth of a millisecond.
  void step();

  Teensy& teensy() { return teensy_; }
  /// Bytes that the robot has sent since the last call, at most into.size().
  std::size_t read_serial(std::span<std::uint8_t> into);
  /// What the cameras saw since the last call, by the robot's clock.
  std::vector<recording::TruthSample> take_truth() { return std::exchange(seen_, {}); }

 private:
  Teensy teensy_;
  simulator::VirtualMocap mocap_;
  std::vector<recording::TruthSample> seen_;
  std::vector<std::uint8_t> received_;
  std::uint64_t clock_us_ = 0;
};

/// A link to it by the serial port, in the same process: waiting for a byte is what makes virtual time pass.
class SerialTransport : public link::Transport {
 public:
  explicit SerialTransport(std::shared_ptr<EmulatedRobot> robot) : robot_(std::move(robot)) {}

  void write(std::span<const std::uint8_t> bytes) override { robot_->teensy().serial().send(bytes); }
  std::size_t read(std::span<std::uint8_t> into, link::microseconds timeout) override;
  link::microseconds now() const override;
  void reopen(link::microseconds timeout) override;
  const std::string& name() const override { return name_; }

 private:
  std::shared_ptr<EmulatedRobot> robot_;
  std::string name_ = "the emulated robot's serial port";
};

class EmulatedTruth : public truth::Source {
 public:
  explicit EmulatedTruth(std::shared_ptr<EmulatedRobot> robot) : robot_(std::move(robot)) {}
  std::vector<recording::TruthSample> poll() override { return robot_->take_truth(); }
  std::string name() const override { return "sim"; }
  std::string clock() const override { return "robot"; }

 private:
  std::shared_ptr<EmulatedRobot> robot_;
};

}  // namespace astro::emulator
