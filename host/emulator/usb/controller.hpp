#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "host/emulator/core/machine.hpp"

namespace astro::emulator {

/// How the device answers a transaction. `nothing`: it is not attached, or has another address.
enum class Handshake : std::uint8_t { ack, nak, stall, nothing };

struct Packet {
  Handshake handshake = Handshake::nothing;
  std::vector<std::uint8_t> bytes;
  bool data1 = false;
};

/// The device controller USB1: its registers towards the firmware, and the bus towards a host. Walks the
/// queue heads and transfer descriptors in memory as the chip's bus master does. Before a known device
/// attaches again, it must be detached long enough for any host to notice.
///
/// Not modelled  isochronous transfers, lists of more than one descriptor, descriptors without IOC, timers.
class UsbController : public Model {
 public:
  UsbController(Machine& machine, std::function<bool()> clocked)
      : machine_(machine), clocked_(std::move(clocked)) {}

  std::uint32_t read(std::uint32_t offset) override;
  void write(std::uint32_t offset, std::uint32_t value) override;
  void reset() override;
  void leave_rom_state() override;

  // The bus.
  bool attached() const;
  /// The host begins and ends a bus reset; afterwards the device has address 0.
  void begin_reset();
  void end_reset(bool high_speed);
  void suspend();
  void resume();
  /// The cable, which is plugged in at the start. Without it the bus is idle for the device.
  void unplug();
  void plug_in() { plugged_ = true; }

  Handshake setup(std::uint8_t address, const std::array<std::uint8_t, 8>& bytes);
  Packet in(std::uint8_t address, int endpoint);
  Handshake out(std::uint8_t address, int endpoint, std::span<const std::uint8_t> bytes, bool data1);

 private:
  struct Queue {  // of a direction of an endpoint
    bool primed = false, data1 = false, empty_packet_due = false;
  };
  static constexpr std::size_t kEndpoints = 8;

  static constexpr std::uint32_t bit_of(int endpoint, bool in) { return 1U << (endpoint + (in ? 16 : 0)); }

  std::span<std::uint8_t> head(int endpoint, bool in);
  std::uint32_t& control(int endpoint) { return endpoint_[static_cast<std::size_t>(endpoint)]; }
  Queue& queue(int endpoint, bool in) {
    return queues_[static_cast<std::size_t>(2 * endpoint + (in ? 1 : 0))];
  }
  bool stalled(int endpoint, bool in);
  bool enabled(int endpoint, bool in);
  std::uint32_t packet_size(int endpoint, bool in);
  void prime(int endpoint, bool in);
  void flush(std::uint32_t bits);
  void retire(int endpoint, bool in, std::uint32_t left);
  void write_endpoint(int endpoint, std::uint32_t value);
  void write_command(std::uint32_t value);
  void attach();
  void leave_bus();
  void raise(std::uint32_t event);
  void refuse(std::uint32_t offset);
  void update();

  Machine& machine_;
  std::function<bool()> clocked_;
  std::uint32_t command_ = 0, status_ = 0, enable_ = 0, address_ = 0, next_address_ = 0, list_ = 0, mode_ = 0;
  std::uint32_t setup_waiting_ = 0, complete_ = 0;
  bool address_due_ = false, resetting_ = false, high_speed_ = false, suspended_ = false;
  bool missed_reset_ = false;  // a bus reset ended before the firmware had flushed what it had primed
  bool plugged_ = true;
  bool on_bus_ = false,
       known_ = false;  // attached by the firmware or by the program before it; known to a host
  Cycles left_at_ = 0;
  std::array<std::uint32_t, kEndpoints> endpoint_{};
  std::array<Queue, 2 * kEndpoints> queues_{};
};

}  // namespace astro::emulator
