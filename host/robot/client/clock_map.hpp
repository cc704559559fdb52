#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace astro::robot {

/// One round trip: the host sent at `sent_us`, the robot read its clock at `device_us`, the answer arrived at
/// `received_us`. All in microseconds, each side on its own steady clock.
struct RoundTrip {
  std::int64_t sent_us = 0;
  std::uint64_t device_us = 0;
  std::int64_t received_us = 0;
};

/// Host time that corresponds to a time stamp of the robot's clock. `bound_us`: the error is at most this, if
/// the two clocks drift at a constant rate (at most kGreatestDrift while the rate is not measured yet). The
/// bound holds however the delay splits between request and answer.
struct HostTime {
  std::int64_t us = 0;
  double bound_us = 0;
};

/// Maps the robot's clock to the host's from round trips.
///
/// Filter  of every kGroup round trips only the fastest is kept: delays only add time, so the fastest one has
///         the smallest error. The last kKept of them are used.
/// Fit     host = offset + slope * device by least squares through the middles of the kept round trips,
///         weighted by 1 / rtt^2. Slope 1 until they span ten times the best round trip.
/// Error   each middle is wrong by at most rtt / 2 and the fit is linear in the middles, which gives the
///         bound.
/// Range   differences of 64-bit counts: nothing wraps, no precision is lost far from the origin.
/// Cost    add: constant. to_host: one sum over at most kKept + 1 round trips.
class ClockMap {
 public:
  static constexpr std::size_t kGroup = 8;
  static constexpr std::size_t kKept = 64;
  static constexpr double kGreatestDrift = 0.05;  // twice that of a poor RC oscillator

  void add(const RoundTrip& trip);

  /// Nothing before the first add().
  std::optional<HostTime> to_host(std::uint64_t device_us) const;

  /// The robot's time at a moment of the host's clock, by the same fit. Nothing before the first add().
  std::optional<std::int64_t> to_device(std::int64_t host_us) const;

  /// Device seconds per host second, minus 1: +0.024 for a robot whose clock runs 2.4 % fast. Nothing while
  /// the slope is assumed, not measured.
  std::optional<double> drift() const;

  /// To be called after a restart of the robot.
  void reset() { *this = ClockMap(); }

 private:
  struct Fit {
    double weight = 0, device = 0, host = 0;  // sum of weights; weighted means relative to the newest trip
    double spread = 0;                        // weighted sum of squares around the mean
    double slope = 1;
    bool measured = false;
  };
  std::vector<RoundTrip> kept_;    // one per whole group, oldest first
  std::optional<RoundTrip> best_;  // of the group under way
  std::size_t in_group_ = 0;

  std::vector<RoundTrip> used() const;
  static Fit fit(const std::vector<RoundTrip>& trips);
};

}  // namespace astro::robot
