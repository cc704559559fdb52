#include "hal/teensy40/flexspi.hpp"

#include "hal/teensy40/core/cpu.hpp"
#include "hal/teensy40/registers/registers.hpp"

namespace astro::teensy40::flexspi_commands {
namespace {

constexpr std::uint32_t kSequence = 15;
constexpr std::uint32_t kTableKey = 0x5AF0'5AF0;
constexpr std::uint32_t kReads = 100'000;  // a millisecond; a page takes 20 us
constexpr std::uint32_t kFlashBase = 0x6000'0000;
constexpr std::uint32_t kCacheLine = 32;

void unlock(bool open) {
  FLEXSPI[flexspi::LUTKEY].write(kTableKey);
  FLEXSPI[flexspi::LUTCR].write(open ? flexspi::LUTCR_UNLOCK(1) : flexspi::LUTCR_LOCK(1));
}

void prepare(FlashCommand command, std::uint32_t offset, std::uint32_t data_bytes) {
  FLEXSPI[flexspi::LUT60].write(command.first);
  FLEXSPI[flexspi::LUT61].write(command.second);
  // Only these flags: writing ones to the queues' flags would advance the queues.
  FLEXSPI[flexspi::INTR].write(flexspi::INTR_IPCMDDONE(1) | flexspi::INTR_IPCMDGE(1) |
                               flexspi::INTR_IPCMDERR(1));
  FLEXSPI[flexspi::IPCR0].write(offset);
  FLEXSPI[flexspi::IPCR1].write(flexspi::IPCR1_ISEQID(kSequence) | flexspi::IPCR1_IDATSZ(data_bytes));
}

/// Writes the next 8 bytes, for which the controller has reported room.
void feed_pair(const std::uint8_t* bytes) {
  const auto word = [bytes](int at) {
    return bytes[at] | std::uint32_t{bytes[at + 1]} << 8 | std::uint32_t{bytes[at + 2]} << 16 |
           std::uint32_t{bytes[at + 3]} << 24;
  };
  FLEXSPI[flexspi::TFDR0].write(word(0));
  FLEXSPI[flexspi::TFDR1].write(word(4));
  FLEXSPI[flexspi::INTR].write(flexspi::INTR_IPTXWE(1));  // passes the pair on
}

/// Triggers the prepared command, supplies its data, and waits for its end.
bool go(std::span<const std::uint8_t> bytes) {
  FLEXSPI[flexspi::IPCMD].write(flexspi::IPCMD_TRG(1));
  for (std::uint32_t reads = kReads; reads != 0; --reads) {
    const std::uint32_t events = FLEXSPI[flexspi::INTR].read();
    if (flexspi::INTR_IPCMDERR.of(events) != 0) return false;
    if (!bytes.empty() && flexspi::INTR_IPTXWE.of(events) != 0) {
      feed_pair(bytes.data());
      bytes = bytes.subspan(8);
    }
    if (flexspi::INTR_IPCMDDONE.of(events) == 0) continue;
    FLEXSPI[flexspi::INTR].write(flexspi::INTR_IPCMDDONE(1));
    return bytes.empty();
  }
  return false;
}

}  // namespace

bool begin() {
  unlock(true);
  return poll(FLEXSPI[flexspi::STS0], flexspi::STS0_ARBIDLE, 1, kReads) &&
         poll(FLEXSPI[flexspi::STS0], flexspi::STS0_SEQIDLE, 1, kReads);
}

void end(std::uint32_t offset, std::uint32_t bytes) {
  unlock(false);
  FLEXSPI[flexspi::MCR0].modify(0, flexspi::MCR0_SWRESET(1));  // empties the mapping's buffers
  static_cast<void>(poll(FLEXSPI[flexspi::MCR0], flexspi::MCR0_SWRESET, 0, kReads));
  // After the command, not before it, because lines may be fetched meanwhile.
  cpu::synchronize();
  const std::uint32_t first = (kFlashBase + offset) & ~(kCacheLine - 1);
  for (std::uint32_t line = first; line < kFlashBase + offset + bytes; line += kCacheLine)
    SCB[scb::DCIMVAC].write(line);
  cpu::synchronize();
  cpu::refetch();
}

bool run(FlashCommand command, std::uint32_t offset) {
  const cpu::InterruptsOff guard;
  prepare(command, offset, 0);
  return go({});
}

bool write(FlashCommand command, std::uint32_t offset, std::span<const std::uint8_t> bytes) {
  const cpu::InterruptsOff guard;
  FLEXSPI[flexspi::IPTXFCR].write(flexspi::IPTXFCR_CLRIPTXF(1));  // and a watermark of 8 bytes
  prepare(command, offset, static_cast<std::uint32_t>(bytes.size()));
  return go(bytes);
}

std::uint32_t read_byte(FlashCommand command) {
  const cpu::InterruptsOff guard;
  FLEXSPI[flexspi::IPRXFCR].write(flexspi::IPRXFCR_CLRIPRXF(1));
  prepare(command, 0, 1);
  return go({}) ? FLEXSPI[flexspi::RFDR0].read() & 0xFF : 0xFF;
}

}  // namespace astro::teensy40::flexspi_commands
