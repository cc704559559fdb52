#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/recording/run.hpp"

namespace astro::simulation {

/// A robot in virtual time that Server puts behind a pty.
class ServedRobot {
 public:
  virtual ~ServedRobot() = default;

  /// Advances by one millisecond.
  virtual void step() = 0;
  /// Virtual time; may restart at 0 with the robot.
  virtual std::uint64_t now_us() = 0;

  /// Whether the robot drives, and stops by itself if its host gives no sign of life.
  virtual bool drives() { return false; }
  /// Whether the host sets the motors' voltages itself, in its own control loop.
  virtual bool is_regulated() { return false; }

  // The robot's ports, numbered from 0: `pty` of ServerConfig leads to port 0, `second_pty` to port 1, `scanner_pty` to the
  // port of a laser scanner.
  static constexpr int kScannerPort = 2;

  /// Number of bytes that write() can take now.
  virtual std::size_t room(int port) = 0;
  virtual void write(int port, std::span<const std::uint8_t> bytes) = 0;
  /// Moves bytes that the robot has sent and returns their number; 0 if none wait.
  virtual std::size_t read(int port, std::span<std::uint8_t> into) = 0;
  /// Whether the port exists: a USB device, and with it its device file, disappears while the robot restarts.
  virtual bool present(int) { return true; }
  /// Whether a program has the port open; called at each check of the connection.
  virtual void set_open(int /*port*/, bool /*open*/, std::uint32_t /*baud*/) {}

  virtual std::vector<recording::TruthSample> take_truth() = 0;
  /// The content of the robot's flash.
  virtual std::span<const std::uint8_t> flash() = 0;
};

}  // namespace astro::simulation
