#pragma once

#include <complex>
#include <optional>
#include <span>
#include <vector>

#include "host/calibration/motion/trajectory.hpp"

/// Speeds and turn rates over time: what two recordings of one drive have in common before their frames and
/// clocks are known.
namespace astro::calibration {

/// The time window over which a speed is computed. Plain: from two moments 2 half_s apart. Averaged: from the
/// means over two adjacent windows of 2 half_s each, which reduces the noise of n samples by 1 / sqrt(n).
struct Window {
  double half_s = 0.1;
  bool averaged = false;

  /// The time span whose samples make one speed.
  double support_s() const { return averaged ? 4 * half_s : 2 * half_s; }
};

/// Speed of a body and turn rate, both in m/s: the turn rate as the speed of a wheel about the centre. Both
/// without sign, so that mirrored axes and exchanged wheels make no difference.
struct Rate {
  double speed_mps = 0, turn_mps = 0;
};

/// A quantity interpolated linearly between its samples, with its integral.
template <class Value>
class Stream {
 public:
  void add(double time_s, Value value);
  /// Change per second about a moment. Nothing near the ends and next to a gap of more than a second.
  std::optional<Value> rate(double time_s, const Window& window) const;

 private:
  Value value_at(std::size_t i, double time_s) const;
  Value integral_at(std::size_t i, double time_s) const;
  std::size_t interval_of(double time_s, std::size_t& last) const;

  std::vector<double> time_s_;
  std::vector<Value> value_, integral_;
  std::vector<int> gaps_;  // before each sample
  mutable std::size_t last_from_ = 0, last_middle_ = 0, last_to_ = 0;
};

/// A body's path in the plane. Without headings its turn rate is zero.
class BodyPath {
 public:
  BodyPath(std::span<const BodySample> samples, bool headings);

  /// Nothing where it is not known. `radius_m` converts the turn rate into a speed.
  std::optional<Rate> rate(double time_s, const Window& window, double radius_m) const;

 private:
  bool headings_;
  Stream<std::complex<double>> position_m_;
  Stream<double> heading_rad_;
};

/// The largest number of time steps into which a recording is divided. A drive of 40 minutes has so many steps of 25 ms. The
/// limit is needed because one wrong time can make a recording seem decades long.
inline constexpr double kMostSteps = 100'000;

/// The path of a point `lever_m` ahead of a nominal robot's centre, from its wheels alone. Before and after
/// their samples it stands still for `beyond_s`. Cost  40 poses for each second, at
/// most kMostSteps.
BodyPath wheel_body(std::span<const WheelSample> wheels, double wheelbase_m, double lever_m, double beyond_s);

/// Rates at equal steps of time, one column each.
struct MotionProfile {
  double first_s = 0, bin_s = 0;
  std::vector<double> speed_mps, turn_mps;
  std::vector<char> known;  // bool in a char: it is read a million times, and a vector of bits is slower
};
MotionProfile profile_of(const BodyPath& path, double from_s, double to_s, double bin_s, const Window& window,
                         double radius_m);

}  // namespace astro::calibration
