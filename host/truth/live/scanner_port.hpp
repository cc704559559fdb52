#pragma once

#include <string>

#include "host/base/descriptor.hpp"
#include "host/truth/scanners/rplidar_driver.hpp"

namespace astro::truth {

/// A serial port or pty with a laser scanner behind it. Opening it throws as robot::open_serial_port().
class ScannerPort : public rplidar::Line {
 public:
  explicit ScannerPort(std::string path) : path_(std::move(path)) {}

  void open(unsigned baud) override;
  void write(ByteView bytes) override;
  std::size_t read(std::span<std::uint8_t> into, std::chrono::microseconds timeout) override;
  /// Lowers DTR to let the motor run. A pty has no such line, and nothing happens.
  void run_motor(bool on) override;
  std::chrono::microseconds now() const override;
  const std::string& name() const override { return path_; }

 private:
  bool wait_for(short events, std::chrono::microseconds timeout) const;
  [[noreturn]] void fail_gone() const;

  std::string path_;
  Descriptor port_;
};

}  // namespace astro::truth
