#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "host/emulator/chip/flash_chip.hpp"
#include "host/emulator/chip/stored.hpp"

namespace astro::emulator {

/// Which rule of the flash's controller was broken. A value is the code of a step or of the flash's command.
enum class FlexspiProblem {
  step_not_modelled,
  command_under_way,
  sequence_not_the_firmwares,
  command_unknown,
  wrong_steps,
  nothing_received,
  overrun,
  wrong_key,
  without_key,
  table_locked
};

/// The controller of the program's flash: commands are sequences in its look-up table. The firmware may use
/// only the last sequence; the first one reads the program.
class Flexspi : public Stored {
 public:
  Flexspi(Machine& machine, FlashChip& flash) : machine_(machine), flash_(flash) {}

  std::uint32_t read(std::uint32_t offset) override;
  void write(std::uint32_t offset, std::uint32_t value) override;
  void event() override;
  void reset() override;

 private:
  struct Command {
    std::uint8_t opcode = 0;
    bool address = false, writes = false, reads = false;
    friend bool operator==(const Command&, const Command&) = default;
  };
  static const Command* known(std::uint8_t opcode);
  Command decode();
  void trigger();
  void execute();
  void receive(std::span<const std::uint8_t> bytes);
  std::size_t queued() const { return to_flash_.size() - sent_; }
  void write_flags(std::uint32_t value);

  Machine& machine_;
  FlashChip& flash_;
  bool key_ = false, unlocked_ = false, running_ = false;
  std::uint32_t events_ = 0;
  std::array<std::uint32_t, 2> pair_{};
  std::vector<std::uint8_t> to_flash_;  // all data of the command
  std::size_t sent_ = 0;                // how many of them have left the queue
  std::deque<std::uint8_t> from_flash_;
  Command command_;
};

}  // namespace astro::emulator
