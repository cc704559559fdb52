#pragma once

#include <cstdint>
#include <functional>

#include "host/emulator/chip/iomuxc.hpp"

namespace astro::emulator {

/// Why a conversion fails.
enum class AdcProblem { not_connected, resolution_not_modelled, not_calibrated, busy, keeper_on };

/// ADC1 with the battery's divider on pin 14, channel 7.
class Adc : public Stored {
 public:
  Adc(Machine& machine, const Iomuxc& iomuxc);

  std::uint32_t read(std::uint32_t offset) override;
  void write(std::uint32_t offset, std::uint32_t value) override;
  void event() override;
  void reset() override;

  /// Volts at the pin.
  std::function<double()> pin_V = [] { return 0.0; };

 private:
  Cycles conversion() const;
  void stop();

  Machine& machine_;
  const Iomuxc& iomuxc_;
  bool calibrated_ = false, complete_ = false, busy_ = false;
  std::uint32_t result_ = 0;
};

}  // namespace astro::emulator
