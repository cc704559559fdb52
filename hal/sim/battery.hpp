#pragma once

#include <cmath>
#include <cstdint>

#include "hal/sim/config.hpp"

/// The motor supply: a source with an internal resistance, and the analog input that measures it.
namespace astro::sim {

class Battery {
 public:
  explicit Battery(const Config& config)
      : open_circuit_V_(config.supply_V), resistance_ohm_(config.supply_ohm), filtered_V_(config.supply_V) {}

  /// Supply voltage under load through a first-order filter of about 50 Hz.
  std::int32_t millivolts() noexcept { return static_cast<std::int32_t>(std::lround(filtered_V_ * 1000.0)); }

  /// As when the charge falls or somebody turns the knob of a bench supply.
  void set_open_circuit_V(double volts) { open_circuit_V_ = volts; }
  double open_circuit_V() const { return open_circuit_V_; }
  double resistance_ohm() const { return resistance_ohm_; }

  /// Called once per tick with the present bus voltage.
  void observe(double bus_V) { filtered_V_ += kFilter * (bus_V - filtered_V_); }

 private:
  static constexpr double kFilter = 0.2696;  // 1 - exp(-2 pi 50 Hz 1 ms)

  double open_circuit_V_, resistance_ohm_, filtered_V_;
};

}  // namespace astro::sim
