#include "host/emulator/chip/flexspi.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>

#include "hal/teensy40/registers/registers.hpp"

namespace astro::emulator {
namespace {

using namespace teensy40;

constexpr std::uint32_t kKey = 0x5AF0'5AF0, kSequence = 15;
constexpr std::uint32_t kCommand = 1, kAddress = 2, kWrite = 8, kRead = 9;  // what a step of a sequence does
constexpr Cycles kPerByte = 160;                                            // 30 MHz, eight bits on a line
constexpr std::size_t kQueue = 128, kPair = 8;                              // bytes
constexpr std::uint8_t kWriteEnable = 0x06, kReadStatus = 0x05, kIdentify = 0x9F, kErase = 0x20;
constexpr std::uint8_t kProgram = 0x02, kProgramByFour = 0x32;

}  // namespace

void Flexspi::reset() {
  Stored::reset();
  key_ = unlocked_ = running_ = false;
  events_ = 0;
  sent_ = 0;
  to_flash_.clear();
  from_flash_.clear();
}

/// The steps of a command that the flash knows; nullptr if it does not know the command.
const Flexspi::Command* Flexspi::known(std::uint8_t opcode) {
  static constexpr std::array<Command, 6> kCommands{
      {{.opcode = kWriteEnable},
       {.opcode = kReadStatus, .reads = true},
       {.opcode = kIdentify, .reads = true},
       {.opcode = kErase, .address = true},
       {.opcode = kProgram, .address = true, .writes = true},
       {.opcode = kProgramByFour, .address = true, .writes = true}}};
  const auto* found = std::ranges::find(kCommands, opcode, &Command::opcode);
  return found == kCommands.end() ? nullptr : found;
}

Flexspi::Command Flexspi::decode() {
  Command command;
  for (std::uint32_t word = 0; word < 4; ++word) {
    const std::uint32_t steps = value(flexspi::LUT60.value + 4 * word);
    for (const std::uint32_t step : {steps & 0xFFFF, steps >> 16}) {
      const std::uint32_t code = step >> 10, operand = step & 0xFF;
      if (code == 0) return command;
      if (code == kCommand)
        command.opcode = static_cast<std::uint8_t>(operand);
      else if (code == kAddress)
        command.address = true;
      else if (code == kWrite)
        command.writes = true;
      else if (code == kRead)
        command.reads = true;
      else
        machine_.fail({fmt::format("FLEXSPI LUT60: a step with code {} is not modelled", code),
                       FlexspiProblem::step_not_modelled,
                       {std::to_string(code)}});
    }
  }
  return command;
}

void Flexspi::trigger() {
  const std::uint32_t setting = value(flexspi::IPCR1.value);
  if (running_)
    return machine_.fail(
        {fmt::format("FLEXSPI IPCMD: triggered while command 0x{:02X} runs", command_.opcode),
         FlexspiProblem::command_under_way,
         {fmt::format("0x{:02X}", command_.opcode)}});
  if (flexspi::IPCR1_ISEQID.of(setting) != kSequence || flexspi::IPCR1_ISEQNUM.of(setting) != 0)
    return machine_.fail(
        {"FLEXSPI IPCR1: only sequence 15 is the firmware's", FlexspiProblem::sequence_not_the_firmwares});
  running_ = true;
  command_ = decode();
  const Cycles takes = kPerByte * (8 + flexspi::IPCR1_IDATSZ.of(setting));
  machine_.wake(*this, machine_.now() + takes);
}

/// Called when the time of the command is over. The command goes on if some of its data are not in the queue
/// yet.
void Flexspi::event() {
  if (!running_) return;
  const std::uint32_t wanted = command_.writes ? flexspi::IPCR1_IDATSZ.of(value(flexspi::IPCR1.value)) : 0;
  if (to_flash_.size() < wanted) {
    sent_ = to_flash_.size();
    return machine_.wake(*this, machine_.now() + kPerByte);
  }
  execute();
  running_ = false;
  events_ |= flexspi::INTR_IPCMDDONE(1);
}

void Flexspi::receive(std::span<const std::uint8_t> bytes) {
  from_flash_.insert(from_flash_.end(), bytes.begin(), bytes.end());
}

void Flexspi::execute() {
  if (const Command* expected = known(command_.opcode); expected == nullptr)
    return machine_.fail(
        {fmt::format("FLEXSPI LUT60: the flash does not know command 0x{:02X}", command_.opcode),
         FlexspiProblem::command_unknown,
         {fmt::format("0x{:02X}", command_.opcode)}});
  else if (*expected != command_)
    return machine_.fail({fmt::format("FLEXSPI LUT60: not the steps of command 0x{:02X}", command_.opcode),
                          FlexspiProblem::wrong_steps,
                          {fmt::format("0x{:02X}", command_.opcode)}});
  const std::uint32_t address = value(flexspi::IPCR0.value);
  const std::uint32_t bytes = flexspi::IPCR1_IDATSZ.of(value(flexspi::IPCR1.value));
  if (command_.opcode == kWriteEnable) flash_.write_enable();
  if (command_.opcode == kReadStatus) receive(std::array{flash_.status()});
  if (command_.opcode == kIdentify) receive(flash_.identity());
  if (command_.opcode == kErase) flash_.erase_sector(address);
  if (!command_.writes) return;
  flash_.program(address, std::span(to_flash_).first(bytes));
  to_flash_.clear();
  sent_ = 0;
}

std::uint32_t Flexspi::read(std::uint32_t offset) {
  if (offset == flexspi::INTR.value) return events_ | flexspi::INTR_IPTXWE(queued() + kPair <= kQueue);
  if (offset == flexspi::STS0.value)
    return flexspi::STS0_ARBIDLE(!running_) | flexspi::STS0_SEQIDLE(!running_);
  if (offset == flexspi::RFDR0.value) {
    if (from_flash_.empty())
      machine_.fail(
          {"FLEXSPI RFDR0: read while the flash has sent nothing", FlexspiProblem::nothing_received});
    std::uint32_t word = 0;
    for (std::uint32_t i = 0; i < 4 && i < from_flash_.size(); ++i)
      word |= std::uint32_t{from_flash_[i]} << (8 * i);
    return word;
  }
  if (offset == flexspi::MCR0.value) return value(offset) & ~flexspi::MCR0_SWRESET(1);
  return value(offset);
}

void Flexspi::write_flags(std::uint32_t word) {
  if (flexspi::INTR_IPTXWE.of(word) != 0) {
    if (queued() + kPair > kQueue)
      machine_.fail({"FLEXSPI TFDR0: overrun, the queue to the flash is full", FlexspiProblem::overrun});
    const auto bytes = std::bit_cast<std::array<std::uint8_t, kPair>>(pair_);
    to_flash_.insert(to_flash_.end(), bytes.begin(), bytes.end());
  }
  events_ &= ~word;
}

void Flexspi::write(std::uint32_t offset, std::uint32_t word) {
  if (offset == flexspi::LUTKEY.value) {
    key_ = word == kKey;
    if (!key_) machine_.fail({"FLEXSPI LUTKEY: not the key", FlexspiProblem::wrong_key});
  } else if (offset == flexspi::LUTCR.value) {
    if (!key_) machine_.fail({"FLEXSPI LUTCR: written without the key", FlexspiProblem::without_key});
    unlocked_ = flexspi::LUTCR_UNLOCK.of(word) != 0;
    key_ = false;
  } else if (offset >= flexspi::LUT60.value) {
    if (!unlocked_) machine_.fail({"FLEXSPI LUT60: the table is locked", FlexspiProblem::table_locked});
    store(offset, word);
  } else if (offset == flexspi::IPCMD.value) {
    if (flexspi::IPCMD_TRG.of(word) != 0) trigger();
  } else if (offset == flexspi::INTR.value) {
    write_flags(word);
  } else if (offset == flexspi::IPTXFCR.value) {
    if (flexspi::IPTXFCR_CLRIPTXF.of(word) != 0) to_flash_.clear();
    sent_ = 0;
  } else if (offset == flexspi::IPRXFCR.value) {
    if (flexspi::IPRXFCR_CLRIPRXF.of(word) != 0) from_flash_.clear();
  } else if (offset == flexspi::TFDR0.value) {
    pair_[0] = word;
  } else if (offset == flexspi::TFDR1.value) {
    pair_[1] = word;
  } else {
    store(offset, word);
  }
}

}  // namespace astro::emulator
