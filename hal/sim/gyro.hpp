#pragma once

#include <cstdint>
#include <vector>

#include "hal/interface/board.hpp"
#include "hal/sim/config.hpp"

namespace astro::sim {

/// A gyro's faults, as its board sees them.
enum class GyroFault : std::uint8_t {
  none,
  unplugged,  // it does not answer
  silent,     // it answers, but there are no new samples
  frozen,     // new samples with the old values
};

/// A rate gyro of three axes with 200 samples a second of 16 bits, +-500 degrees a second. A sample is the mean rate of the 5 ms
/// before it, with white noise, a bias that walks, and a scale error; what is beyond the range is cut off. It starts in 65 ms.
/// The noise has streams of its own and is numbered by samples, so a robot drives the same bits with a gyro and without.
///
/// Cost    none while there is none; else three Gaussians a sample.
class Gyro {
 public:
  static constexpr int kPeriod_ticks = 5, kStart_ticks = 65;
  static constexpr double kCount_radps = 500.0 / 32000.0 * 0.017453292519943295;

  explicit Gyro(const Config& config);

  const hal::GyroReading& read() noexcept { return reading_; }

  // What only the board and its owner see.

  bool exists() const { return exists_; }
  /// One tick has passed; `heading_rad` is the body's, not wrapped.
  void advance(double heading_rad);
  /// The body was put down with this heading, which is no motion.
  void place(double heading_rad);
  /// The processor has restarted, and with it what it knows of the gyro.
  void restart();
  void set_fault(GyroFault fault) { fault_ = fault; }
  GyroFault fault() const { return fault_; }
  void set_temperature(double temperature_C) { gyro_.temperature_C = temperature_C; }
  double bias_radps() const;

 private:
  void sample();
  std::int16_t counts(double rate_radps, std::uint64_t axis) const;

  GyroConfig gyro_;
  bool exists_ = false;
  std::uint64_t seed_ = 0, number_ = 0;
  GyroFault fault_ = GyroFault::none;
  hal::GyroReading reading_;
  std::vector<double> headings_;  // a ring: of the sample period and the lag before it
  std::size_t at_ = 0;
  int ticks_ = 0;  // since it was plugged in
  double walked_radps_ = 0;
};

}  // namespace astro::sim
