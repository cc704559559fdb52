#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "host/emulator/core/machine.hpp"

/// The endpoints of the USB device controller: their control registers, and a pipe for each direction. The
/// data of the pipes are in the memory to which the queue heads point.
namespace astro::emulator {

/// What is wrong with a queue head, its transfer or an endpoint's control register. The value of the last two
/// is the endpoint's number.
enum class EndpointProblem {
  no_transfer,
  transfer_misaligned,
  head_halted,
  transfer_inactive,
  list_not_modelled,
  no_interrupt_when_done,
  pages_missing,
  transfer_under_way,
  unused_direction_is_control
};

/// The queue head of one direction of an endpoint in the machine's memory, with its copy of the transfer
/// descriptor under way, read and written as the chip's bus master does it.
///
/// Errors  what the firmware wrote wrongly ends the run (Machine::fail).
class QueueHead {
 public:
  static constexpr std::uint32_t kBytes = 64;

  QueueHead(Machine& machine, std::uint32_t address)
      : machine_(machine), bytes_(machine.dma(address, kBytes)) {}

  /// False if the address is no memory of a bus master; nothing else may be called then.
  bool exists() const { return !bytes_.empty(); }

  std::uint32_t packet_size() const;
  bool interrupts_on_setup() const;
  /// A transfer that fills its last packet ends with an empty one.
  bool ends_with_empty_packet() const;
  void store_setup(const std::array<std::uint8_t, 8>& packet);

  /// Copies the transfer descriptor to which it points. If the firmware made the descriptor wrongly, ends the
  /// run and returns false.
  bool load_transfer();
  std::uint32_t bytes_left() const;
  /// Takes the next bytes of the transfer, and returns where they are in memory.
  std::span<std::uint8_t> take(std::uint32_t bytes);
  /// Marks the transfer in the descriptor as completed. Returns false if the descriptor is not in memory any
  /// more.
  bool retire();

 private:
  Machine& machine_;
  std::span<std::uint8_t> bytes_;
};

/// How the device answers a transaction. `nothing`: it is not attached, or has another address.
enum class Handshake : std::uint8_t { ack, nak, stall, nothing };

struct Packet {
  Handshake handshake = Handshake::nothing;
  std::vector<std::uint8_t> bytes;
  bool data1 = false;
};

/// One direction of an endpoint: whether a transfer is under way (primed), and whether the next packet is
/// DATA0 or DATA1. The data are in the memory to which its queue head points.
class Pipe {
 public:
  bool primed() const { return primed_; }
  /// Begins the transfer that the queue head names.
  void prime(QueueHead head);
  void flush() { primed_ = false; }
  void begin_with_data0() { data1_ = false; }
  /// After a SETUP packet DATA1 follows. A primed transfer stays primed.
  void take_setup();

  // A transaction, while a transfer is under way.
  Packet in(QueueHead head);
  /// False for a packet with the toggle of the one before: the host has repeated it, so it is acknowledged
  /// and dropped.
  bool expects(bool data1) const { return data1 == data1_; }
  /// Precondition: the bytes are not more than the transfer takes.
  void out(QueueHead head, std::span<const std::uint8_t> bytes);

 private:
  void retire(QueueHead head);

  bool primed_ = false, data1_ = false, empty_packet_due_ = false;
};

/// The endpoints' control registers (ENDPTCTRL0 to 7), and a pipe for both directions of each.
class Endpoints {
 public:
  static constexpr std::size_t kCount = 8;

  /// The bit of one direction of an endpoint in the registers that have one bit for each.
  static constexpr std::uint32_t bit_of(int endpoint, bool in) { return 1U << (endpoint + (in ? 16 : 0)); }

  std::uint32_t control(std::size_t endpoint) const { return control_[endpoint]; }
  /// Called when the firmware writes the control register. Ends the run if this breaks a rule.
  void write_control(std::size_t endpoint, std::uint32_t value, Machine& machine);
  bool enabled(int endpoint, bool in) const;
  bool stalled(int endpoint, bool in) const;

  Pipe& pipe(int endpoint, bool in) { return pipes_[index_of(endpoint, in)]; }
  const Pipe& pipe(int endpoint, bool in) const { return pipes_[index_of(endpoint, in)]; }
  /// The pipes with a transfer under way, as bits.
  std::uint32_t primed() const;
  void flush(std::uint32_t bits);
  /// Takes a SETUP packet at endpoint 0, which ends a stall.
  void take_setup();

 private:
  static constexpr std::size_t index_of(int endpoint, bool in) {
    return static_cast<std::size_t>(2 * endpoint + (in ? 1 : 0));
  }
  static constexpr std::uint32_t kAlwaysOn = 0x0080'0080;  // both directions of endpoint 0

  std::array<std::uint32_t, kCount> control_{kAlwaysOn};
  std::array<Pipe, 2 * kCount> pipes_{};
};

}  // namespace astro::emulator
