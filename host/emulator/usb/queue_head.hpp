#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "host/emulator/core/machine.hpp"

namespace astro::emulator {

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

  /// Copies the descriptor that it names. Returns false, and has ended the run, if the firmware made it
  /// wrongly.
  bool load_transfer();
  std::uint32_t bytes_left() const;
  /// Takes the next bytes of the transfer: where they are in memory.
  std::span<std::uint8_t> take(std::uint32_t bytes);
  /// Writes to the descriptor that the transfer is over. Returns false if it is in no memory any more.
  bool retire();

 private:
  Machine& machine_;
  std::span<std::uint8_t> bytes_;
};

}  // namespace astro::emulator
