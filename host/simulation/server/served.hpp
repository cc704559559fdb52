#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/recording/run/run.hpp"

namespace astro::simulation {

/// A robot in virtual time that Server puts behind a pty.
class Served {
 public:
  virtual ~Served() = default;

  /// One millisecond.
  virtual void step() = 0;
  /// Virtual; may start again at 0 when the robot does.
  virtual std::uint64_t now_us() = 0;

  // The robot's ports, numbered from 0: `pty` of ServerConfig leads to port 0, `second_pty` to port 1.

  /// Bytes that write() takes now.
  virtual std::size_t room(int port) = 0;
  virtual void write(int port, std::span<const std::uint8_t> bytes) = 0;
  /// Bytes that the robot has sent; 0 if none wait.
  virtual std::size_t read(int port, std::span<std::uint8_t> into) = 0;
  /// A USB device goes when the robot restarts, and its device file with it.
  virtual bool present(int) { return true; }
  /// A program has the port open, or not any more; asked each time its state is looked at.
  virtual void set_open(int /*port*/, bool /*open*/, std::uint32_t /*baud*/) {}

  virtual std::vector<recording::TruthSample> take_truth() = 0;
  /// What the robot keeps without power.
  virtual std::span<const std::uint8_t> flash() = 0;
};

}  // namespace astro::simulation
