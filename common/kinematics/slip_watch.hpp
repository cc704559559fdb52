#pragma once

#include <array>
#include <cstdint>

#include "common/kinematics/heading_filter.hpp"

namespace astro {

/// Turns of the robot that no wheel has seen: a kick, a wheel that spins, a carpet. The innovations of the heading filter are summed
/// over 0.3 s, for slow slips, and over 0.15 s, for quick ones, and compared with what gyro and wheels may differ by in that time T:
///
///   sigma^2 = gyro's noise + wheels' slip + rounding to counts + (T x doubt of the bias)^2
///             + (2 ms of doubt between the clocks of gyro and counts x change of the yaw rate)^2 + (0.1 % of the turn)^2
///
/// A sum beyond 5.5 sigma is a slip, but never one below 0.6 degrees: tyres give 0.3 after a spin. One slip is told once; the next
/// can be told when both sums have stayed below their thresholds for 0.3 s.
///
/// Cost    constant, no division and no root; callable from the control tick. One call every HeadingFilter::kStep_ms.
class SlipWatch {
 public:
  static constexpr int kWindow = 30;  // steps

  void configure(const HeadingFilter::Configuration& configuration) { rounding_ = configuration.rounding; }

  /// One step and the filter as it was advanced with it. True if a slip is found with this step.
  bool advance(const HeadingStep& step, const HeadingFilter& filter);
  /// Forgets the steps so far. Call it when a step is left out.
  void reset();

  /// A slip was found, and the sums have not been below their thresholds for 0.3 s since.
  bool slipping() const { return calm_ < kWindow; }
  /// How much further the robot has turned in the last 0.3 s than the wheels say, 2^-32 turn.
  std::int64_t unseen_32() const { return -long_.innovation; }

 private:
  static constexpr int kShort = 15;
  struct Entry {
    std::int32_t innovation_32 = 0, wheels_32 = 0;
    std::uint32_t path_20 = 0;
  };
  struct Window {
    std::int64_t innovation = 0, turn = 0, path = 0;  // sums
    void replace(const Entry& oldest, const Entry& newest);
  };
  /// `change`: of the wheels' turn in a step, from the beginning of the window to its end.
  bool exceeds_noise(const Window& window, int steps, std::int64_t change, const HeadingFilter& filter) const;

  std::int64_t rounding_ = 0;
  std::array<Entry, kWindow> ring_{};
  int at_ = 0;
  int calm_ = kWindow;  // steps in a row below the thresholds
  Window short_, long_;
};

}  // namespace astro
