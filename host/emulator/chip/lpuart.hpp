#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <span>
#include <vector>

#include "host/emulator/chip/clocks.hpp"
#include "host/emulator/chip/iomuxc.hpp"

namespace astro::emulator {

/// What the serial port loses or cannot do. The value of too_few_samples is their number for each bit.
enum class LpuartProblem {
  receiver_overrun,
  transmitter_overrun,
  character_never_reported,
  nothing_received,
  too_few_samples,
  divider_zero,
  transmitter_off,
  running
};

/// LPUART6, and the wire to a host on pins 0 and 1: bytes take the time that the baud rate gives them, both
/// ways.
class Lpuart : public Model {
 public:
  Lpuart(Machine& machine, const Ccm& ccm, const Iomuxc& iomuxc)
      : machine_(machine), ccm_(ccm), iomuxc_(iomuxc) {}

  std::uint32_t read(std::uint32_t offset) override;
  void write(std::uint32_t offset, std::uint32_t value) override;
  void event() override;
  void reset() override;

  /// How long the processor waits for each register that it reads, because other masters use the bus.
  Cycles read_takes = 0;

  // The host's end.
  void send(std::span<const std::uint8_t> bytes);
  std::vector<std::uint8_t> receive();
  /// Number of bytes of send() that have not reached the chip yet.
  std::size_t underway() const { return incoming_.size(); }
  std::uint32_t baud() const;
  /// Stops the wire to the host, so that a test can fill the robot's queue.
  void hold_wire(bool hold) {
    held_ = hold;
    if (!hold && !sending_.empty() && departs_at_ <= machine_.now())
      departs_at_ = machine_.now() + byte_time();
    update();
  }

 private:
  bool connected() const;
  Cycles byte_time() const { return kCyclesPerSecond * 10 / baud(); }
  void arrive();
  void depart();
  std::size_t capacity(teensy40::Bits enable) const;
  void write_baud(std::uint32_t value);
  void write_fifo(std::uint32_t value);
  void write_data(std::uint32_t value);
  std::uint32_t read_data();
  std::uint32_t status() const;
  bool stranded() const;
  void update();

  Machine& machine_;
  const Ccm& ccm_;
  const Iomuxc& iomuxc_;
  std::uint32_t baud_ = 0x0F00'0004, control_ = 0, fifo_ = 0, water_ = 0, events_ = 0;
  std::deque<std::uint8_t> received_, sending_;
  std::deque<std::uint8_t> incoming_;
  std::vector<std::uint8_t> outgoing_;
  bool held_ = false;
  Cycles arrives_at_ = kNever, departs_at_ = kNever, idle_at_ = kNever, found_by_ = kNever;
};

}  // namespace astro::emulator
