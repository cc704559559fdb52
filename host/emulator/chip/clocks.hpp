#pragma once

#include <cstdint>
#include <functional>

#include "host/emulator/chip/stored.hpp"

namespace astro::emulator {

/// Which rule of clocks and supplies was broken. The value is the clock in MHz; for voltage_too_low the
/// voltage in millivolts precedes it.
enum class ClockProblem {
  pll_in_use,
  pll_factor_out_of_range,
  voltage_too_high,
  voltage_too_low,
  crystal_not_selected,
  arm_pll_not_selected,
  pll_not_locked,
  pll_bypassed,
  too_fast_for_voltage,
  core_too_fast,
  bus_too_fast,
  last_change_under_way,
  timer_clock_not_whole
};

/// PLLs, band gap and supplies of the analogue parts: CCM_ANALOG and PMU, which share a page. A PLL locks 60
/// us after it was switched on.
class Analog : public Stored {
 public:
  explicit Analog(Machine& machine);

  std::uint32_t read(std::uint32_t offset) override;
  void write(std::uint32_t offset, std::uint32_t value) override;
  void reset() override;

  bool arm_pll_locked() const { return machine_.now() >= arm_locked_at_; }
  bool arm_pll_bypassed() const;
  std::uint32_t arm_pll_mhz() const;
  bool usb_pll_ready() const;
  /// Whether the core runs from the ARM PLL; called before each write to that PLL, which must not change
  /// while it does.
  std::function<bool()> core_runs_from_arm_pll = [] { return false; };

 private:
  Machine& machine_;
  Cycles arm_locked_at_ = 0, usb_locked_at_ = kNever;
};

/// The core's supply: a change takes effect 30 us later.
class Dcdc : public Stored {
 public:
  explicit Dcdc(Machine& machine);
  std::uint32_t read(std::uint32_t offset) override;
  void write(std::uint32_t offset, std::uint32_t value) override;
  std::uint32_t millivolts() const;
  /// Frequency of the core; called before each change of the supply, which must be high enough for it.
  std::function<std::uint32_t()> core_mhz = [] { return 0U; };

 private:
  Machine& machine_;
  Cycles settled_at_ = 0;
};

/// The clock controller: dividers and selectors with their handshakes, and the gates. The gates of parts that
/// the ROM does not use are closed after it, so that a driver that forgets to open one is detected.
class Ccm : public Stored {
 public:
  Ccm(Machine& machine, Analog& analog, Dcdc& dcdc);

  std::uint32_t read(std::uint32_t offset) override;
  void write(std::uint32_t offset, std::uint32_t value) override;
  void reset() override;

  bool open(Gate gate) const;
  std::uint32_t core_mhz() const;
  std::uint32_t bus_mhz() const;
  std::uint32_t uart_hz() const;
  std::uint32_t i2c_hz() const;
  std::uint32_t timer_hz() const;  // PIT

 private:
  bool from_pll() const;
  void check_source();
  void check_supply();

  Machine& machine_;
  Analog& analog_;
  Dcdc& dcdc_;
  std::uint32_t busy_ = 0;  // of CDHIPR
  Cycles busy_until_ = 0;
};

}  // namespace astro::emulator
