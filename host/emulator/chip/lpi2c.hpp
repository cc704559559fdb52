#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "host/emulator/chip/clocks.hpp"
#include "host/emulator/chip/gpio.hpp"
#include "host/emulator/chip/iomuxc.hpp"

namespace astro::emulator {

/// What the controller or its driver does wrong. The value of too_fast and low_too_short is what the registers say, in Hz and ns.
enum class Lpi2cProblem {
  running,
  off,
  queue_full,
  nothing_received,
  no_start,
  not_connected,
  not_open_drain,
  too_fast,
  low_too_short,
  left_in_queue
};

/// A chip at the I2C bus.
class I2cDevice {
 public:
  virtual ~I2cDevice() = default;
  /// A start with this address; true: it acknowledges and has the bus until the stop.
  virtual bool addressed(std::uint8_t address, bool reads) = 0;
  /// False: it does not acknowledge.
  virtual bool write(std::uint8_t byte) = 0;
  virtual std::uint8_t read() = 0;
};

/// LPI2C1 as a controller, and the bus on pins 18 and 19 with the chips at it. Bytes take the time that the timing registers give
/// them. A full queue of received bytes, or an empty one of commands, holds the clock.
///
/// Not modelled  the target's side, other controllers, interrupts, DMA, automatic stops, time-outs of held lines.
class Lpi2c : public Model {
 public:
  Lpi2c(Machine& machine, const Ccm& ccm, const Iomuxc& iomuxc, Gpio& gpio1)
      : machine_(machine), ccm_(ccm), iomuxc_(iomuxc), gpio1_(gpio1) {}

  std::uint32_t read(std::uint32_t offset) override;
  void write(std::uint32_t offset, std::uint32_t value) override;
  void event() override;
  void reset() override;

  // The other ends of the lines.
  std::vector<I2cDevice*> devices;
  /// Somebody holds the clock low.
  void hold_clock(bool held);
  /// A chip in the middle of a byte holds the data line low until it has seen so many clocks.
  void hold_data(int clocks);
  bool data_held() const { return data_held_clocks_ != 0; }
  /// The firmware has changed pins of GPIO1, with which it may move the lines itself.
  void pins_changed();

  /// How many starts the controller has made since the last reset.
  std::uint32_t starts() const { return starts_; }

 private:
  bool enabled() const;
  bool connected();
  std::uint32_t clock_hz() const { return ccm_.i2c_hz(); }
  Cycles bit_time() const;
  void check_timing();
  void push(std::uint32_t word);
  void flush(std::uint32_t control);
  void go_on();
  bool begin(std::uint32_t word);
  void finish();
  void finish_start();
  void refuse();
  void show_lines();

  Machine& machine_;
  const Ccm& ccm_;
  const Iomuxc& iomuxc_;
  Gpio& gpio1_;
  std::uint32_t control_ = 0, events_ = 0, configuration1_ = 0, configuration2_ = 0, timing_ = 0;
  std::deque<std::uint32_t> commands_;
  std::deque<std::uint8_t> received_;
  std::uint32_t now_ = 0;  // the command under way
  int left_ = 0;           // bytes that it is still to receive
  Cycles done_at_ = kNever;
  I2cDevice* device_ = nullptr;
  bool owns_bus_ = false, reads_ = false;
  bool clock_held_ = false, clock_was_low_ = false;
  int data_held_clocks_ = 0;
  std::uint32_t starts_ = 0;
};

}  // namespace astro::emulator
