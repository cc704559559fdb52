#pragma once

#include <array>
#include <cstdint>

#include "host/emulator/chip/iomuxc.hpp"

namespace astro::emulator {

/// What the model of the PWM cannot do, or which write has no effect on the chip.
enum class PwmProblem {
  prescaler_not_modelled,
  never_loaded,
  clock_not_modelled,
  complementary_not_modelled,
  fault_mode_not_modelled,
  output_control_not_modelled,
  fractions_not_modelled,
  values_wait
};

/// FlexPWM2 with its submodule 2, whose outputs A and B are pins 6 and 9. Its counter runs at 150 MHz,
/// whatever the clock controller says.
///
/// Not modelled  prescaler, complementary outputs, polarity, fractional edges, faults that clear themselves.
class FlexPwm : public Stored {
 public:
  FlexPwm(Machine& machine, const Iomuxc& iomuxc);

  std::uint32_t read(std::uint32_t offset) override;
  void write(std::uint32_t offset, std::uint32_t value) override;
  void event() override;
  void reset() override;

  /// The fraction of its period in which a pin is high: 0 is A (left), 1 is B (right). A pad that is not
  /// connected to FlexPWM is low, because of the driver chip's pull-down.
  double duty(std::size_t output) const;
  std::uint32_t period_counts() const;

 private:
  struct Values {
    std::uint16_t initial = 0, val1 = 0;
    std::array<std::uint16_t, 2> rise{}, fall{};
  };
  void write_mctrl(std::uint32_t value);
  void write_mask(std::uint32_t value);
  void refuse_unmodelled();
  void load_when_period_ends();
  std::uint32_t faults_now() const;
  void load();
  bool running() const;
  bool locked() const;
  Values buffered() const;

  Machine& machine_;
  const Iomuxc& iomuxc_;
  Values active_;
  std::uint32_t mask_ = 0;     // in effect
  std::uint32_t faults_ = 15;  // flags that keep the outputs off
  Cycles period_began_ = 0;
};

}  // namespace astro::emulator
