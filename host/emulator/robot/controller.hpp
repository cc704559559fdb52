#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>

#include "host/emulator/chip/stored.hpp"
#include "host/emulator/core/machine.hpp"
#include "host/emulator/robot/endpoints.hpp"

namespace astro::emulator {

/// Which rule of the controller was broken. The value is an endpoint's number; for not_modelled the register.
enum class UsbProblem {
  attached_before_device_mode,
  attached_without_clock,
  attached_without_queue_heads,
  attached_again_too_soon,
  queue_heads_misaligned,
  not_modelled,
  primed_before_device_mode,
  primed_without_reset,
  transfer_under_way,
  setup_waits,
  not_enabled,
  too_many_bytes
};

/// The device controller USB1: its registers towards the firmware, and the bus towards a host. Packets go
/// through the pipes of its endpoints, whose transfers are in memory (endpoints.hpp).
/// Before a known device attaches again, it must be detached long enough for any host to notice.
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
  /// Unplugs the cable, which is plugged in at the start. Without it the device sees an idle bus.
  void unplug();
  void plug_in() { plugged_ = true; }

  Handshake setup(std::uint8_t address, const std::array<std::uint8_t, 8>& bytes);
  Packet in(std::uint8_t address, int endpoint);
  Handshake out(std::uint8_t address, int endpoint, std::span<const std::uint8_t> bytes, bool data1);

 private:
  QueueHead head(int endpoint, bool in);
  /// Whether a packet with this address reaches the device.
  bool answers(std::uint8_t address) const;
  void prime(int endpoint, bool in);
  void note_complete(int endpoint, bool in);
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
  Endpoints endpoints_;
};

/// The transceiver USBPHY1: each register has further addresses that set and clear its bits.
class UsbPhy : public Stored {
 public:
  UsbPhy();
  std::uint32_t read(std::uint32_t offset) override { return value(offset & ~0xFU); }
  void write(std::uint32_t offset, std::uint32_t value) override;
  bool ready() const;
};

}  // namespace astro::emulator
