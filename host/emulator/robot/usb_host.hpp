#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "host/emulator/robot/teensy.hpp"

namespace astro::emulator {

/// A USB host on the other end of the cable, in virtual time: what it does, a test says. Repeats what is
/// answered by NAK, a microframe later each time.
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

  /// Control transfers, with all their stages. `data` is what came, or what is sent.
  Outcome read(const Request& request, std::vector<std::uint8_t>& data);
  Outcome write(const Request& request, std::span<const std::uint8_t> data = {});
  /// The SETUP packet alone: the host thinks better of it.
  Handshake setup_only(const Request& request);

  /// Gives the device this address, and uses it from now on.
  Outcome set_address(std::uint8_t address);

  /// One bulk transfer to the device; false if it did not take all within `limit`.
  bool send(int endpoint, std::span<const std::uint8_t> bytes, std::chrono::microseconds limit);
  /// One packet from the device, if it has one within `limit`. One with the toggle of the last is a
  /// repetition, and passed over.
  std::optional<Packet> receive(int endpoint, std::chrono::microseconds limit);

  std::uint16_t bulk_packet() const { return bulk_packet_; }

 private:
  void follow(const Request& request);
  void begin_toggles_anew();
  Handshake patiently(const std::function<Handshake()>& transaction);
  Packet patient_in(int endpoint);

  Teensy& teensy_;
  std::uint8_t address_ = 0;
  std::uint16_t packet_ = 64;
  std::uint16_t bulk_packet_ = 512;
  std::array<bool, 16> out_data1_{}, in_data1_{};  // toggles of the next packets
};

}  // namespace astro::emulator
