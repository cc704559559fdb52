#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "host/emulator/robot/teensy.hpp"

namespace astro::emulator {

/// A USB host at the other end of the cable, in virtual time; a test decides what it does. A transaction that
/// is answered by NAK is repeated in the next microframe.
class UsbHost {
 public:
  struct Request {
    std::uint8_t type, request;
    std::uint16_t value, index, length;
  };
  enum class Outcome : std::uint8_t { done, stalled, no_answer };

  explicit UsbHost(Teensy& teensy) : teensy_(teensy) {}

  /// Resets the bus for 10 ms; the device is at address 0 then.
  void reset(bool high_speed = true);
  void suspend();
  void resume();

  /// Control transfers with all their stages. `data`: the bytes received, or the bytes to send.
  Outcome read(const Request& request, std::vector<std::uint8_t>& data);
  Outcome write(const Request& request, std::span<const std::uint8_t> data = {});
  /// Sends the SETUP packet alone; the host gives the transfer up.
  Handshake setup_only(const Request& request);

  /// Gives the device this address, and uses it from now on.
  Outcome set_address(std::uint8_t address);

  /// One bulk transfer to the device; false if it did not take all within `limit`.
  bool send(int endpoint, std::span<const std::uint8_t> bytes, std::chrono::microseconds limit);
  /// One packet from the device, if it has one within `limit`. A packet with the toggle of the last one is a
  /// repetition and is ignored.
  std::optional<Packet> receive(int endpoint, std::chrono::microseconds limit);

  std::uint16_t bulk_packet() const { return bulk_packet_; }

 private:
  void follow(const Request& request);
  void reset_toggles();
  Handshake retry_nak(const std::function<Handshake()>& transaction);
  Packet in_with_retries(int endpoint);

  Teensy& teensy_;
  std::uint8_t address_ = 0;
  std::uint16_t packet_ = 64;
  std::uint16_t bulk_packet_ = 512;
  std::array<bool, 16> out_data1_{}, in_data1_{};  // toggles of the next packets
};

}  // namespace astro::emulator
