#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "host/emulator/robot/teensy.hpp"
#include "host/emulator/robot/usb_cdc.hpp"
#include "host/robot/port/transport.hpp"
#include "host/simulation/robot/virtual_mocap.hpp"

namespace astro::emulator {

enum class Port : std::uint8_t { serial, usb };

/// An emulated Teensy on its robot, watched by the virtual cameras, with a computer at both of its ports.
class EmulatedRobot {
 public:
  EmulatedRobot(const std::filesystem::path& hex, const sim::Config& config,
                const simulation::MocapConfig& mocap)
      : teensy_(hex, config), mocap_(mocap) {}

  /// Runs for a fifth of a millisecond.
  void step();

  Teensy& teensy() { return teensy_; }
  /// The computer's side of the USB port; not open at first.
  CdcHost& usb() { return usb_; }

  void send(Port port, std::span<const std::uint8_t> bytes);
  /// Number of bytes that were sent and have not arrived at the robot yet.
  std::size_t underway(Port port);
  /// Bytes that the robot has sent since the last call, at most into.size().
  std::size_t receive(Port port, std::span<std::uint8_t> into);
  /// What the cameras saw since the last call, by the robot's clock.
  std::vector<recording::TruthSample> take_truth() { return std::exchange(seen_, {}); }

 private:
  std::vector<std::uint8_t>& received(Port port) { return received_[static_cast<std::size_t>(port)]; }

  Teensy teensy_;
  CdcHost usb_{teensy_};
  simulation::VirtualMocap mocap_;
  std::vector<recording::TruthSample> seen_;
  std::array<std::vector<std::uint8_t>, 2> received_;
  std::uint64_t clock_us_ = 0;
};

/// A link to an EmulatedRobot in the same process. Virtual time passes only while the host waits for a byte.
/// Keeps the USB port open for as long as it lives. Errors as those of a device file.
class PortTransport : public robot::Transport {
 public:
  PortTransport(std::shared_ptr<EmulatedRobot> robot, Port port);
  ~PortTransport() override;

  void write(std::span<const std::uint8_t> bytes) override;
  std::size_t read(std::span<std::uint8_t> into, microseconds timeout) override;
  microseconds now() const override;
  void reopen(microseconds timeout) override;
  const std::string& name() const override { return name_; }

 private:
  bool present() const { return port_ == Port::serial || robot_->usb().present(); }
  void check_present() const;

  std::shared_ptr<EmulatedRobot> robot_;
  Port port_;
  std::string name_;
};

}  // namespace astro::emulator
