#pragma once

#include <complex>
#include <optional>
#include <span>
#include <vector>

#include "host/calibration/motion/trajectory.hpp"

/// How fast something moves, which is what two recordings of one drive have in common before their frames and
/// clocks are known.
namespace astro::calibration {

/// Over what time a speed is taken. Plain: between two moments 2 half_s apart. Averaged: between the means
/// over two neighbouring times of 2 half_s each, which lets noise of n samples in each count by 1 / sqrt(n).
struct Window {
  double half_s = 0.1;
  bool averaged = false;

  /// The time that one speed is made from.
  double support_s() const { return averaged ? 4 * half_s : 2 * half_s; }
};

/// Speed of a body and turn rate, both in m/s: the turn rate is that of a wheel about the centre. Signs are
/// left out, so that mirrored axes and exchanged wheels look alike.
struct Rate {
  double speed_mps = 0, turn_mps = 0;
};

/// A quantity between its samples, on a line, with its integral.
template <class Value>
class Stream {
 public:
  void add(double time_s, Value value);
  /// Change per second about a moment. Nothing near the ends and beside a gap of more than a second.
  std::optional<Value> rate(double time_s, const Window& window) const;

 private:
  std::optional<std::size_t> covering(double from_s, double to_s) const;
  Value value_at(std::size_t i, double time_s) const;
  Value integral_at(double time_s) const;
  std::size_t interval_of(double time_s) const;

  std::vector<double> time_s_;
  std::vector<Value> value_, integral_;
  std::vector<int> gaps_;  // before each sample
};

/// A body's way through the plane. Without headings its turn rate is zero.
class BodyPath {
 public:
  BodyPath(std::span<const BodySample> samples, bool headings);

  /// Nothing where it is not known. `radius_m`: what makes a turn a speed.
  std::optional<Rate> rate(double time_s, const Window& window, double radius_m) const;

 private:
  bool headings_;
  Stream<std::complex<double>> position_m_;
  Stream<double> heading_rad_;
};

/// A point `lever_m` ahead of a nominal robot's centre, by its wheels alone; beyond their ends it stands
/// still, for so long as `beyond_s`. Cost  40 poses for each second.
BodyPath wheel_body(std::span<const WheelSample> wheels, double wheelbase_m, double lever_m, double beyond_s);

/// Rates at equal steps of time, one column each.
struct MotionProfile {
  double first_s = 0, bin_s = 0;
  std::vector<double> speed_mps, turn_mps;
  std::vector<char> known;  // whether; not a vector of bits, for it is asked a million times
};
MotionProfile profile_of(const BodyPath& path, double from_s, double to_s, double bin_s, const Window& window,
                         double radius_m);

}  // namespace astro::calibration
