#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <span>
#include <utility>
#include <vector>

#include "host/emulator/robot/usb_host.hpp"

namespace astro::emulator {

/// What an operating system does for a serial port on USB (CDC-ACM): enumerates the device whenever it
/// appears, sets the line when a program opens the port, and moves bytes.
///
/// Throws astro::Error if the device is no serial port, or does not answer as one.
class CdcHost {
 public:
  explicit CdcHost(Teensy& teensy) : teensy_(teensy), host_(teensy) {}

  /// Does what is due. Enumeration takes some 30 ms of virtual time, moving bytes takes a microframe per
  /// packet.
  void step();

  /// Whether the device has been enumerated.
  bool present() const { return present_; }
  /// Opens the port, or sets another baud rate, as a program does. The device may be absent.
  void open(std::uint32_t baud);
  void close();

  /// Sends bytes; they are lost if the port is closed.
  void send(std::span<const std::uint8_t> bytes) {
    if (open_) to_device_.insert(to_device_.end(), bytes.begin(), bytes.end());
  }
  /// Number of bytes that the device has not taken yet.
  std::size_t underway() const { return to_device_.size(); }
  /// The bytes received since the last call.
  std::vector<std::uint8_t> receive() { return std::exchange(received_, {}); }

 private:
  struct Pipes {
    std::uint8_t control_interface = 0;
    int in = 0, out = 0;
  };

  struct Detached {};  // thrown if the device leaves the bus during a request, which is allowed

  void expect(bool fulfilled, const char* what);
  template <class Work>
  void while_attached(Work work);
  void enumerate();
  Pipes pipes_of(std::span<const std::uint8_t> configuration);
  void set_line();
  void send_bytes();
  void take_bytes();

  Teensy& teensy_;
  UsbHost host_;
  Pipes pipes_;
  bool present_ = false, open_ = false;
  std::uint32_t baud_ = 115'200;
  std::deque<std::uint8_t> to_device_;
  std::vector<std::uint8_t> received_;
};

}  // namespace astro::emulator
