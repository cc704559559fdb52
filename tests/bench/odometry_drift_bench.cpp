// How far odometry drifts in an hour by arithmetic alone: integer counts of a robot that drives a path at 1
// kHz go through our odometry, one in float32 with Euler steps (as common firmware does it) and one in double
// with exact arcs. The reference takes the same counts through exact arcs in long double, with the geometry
// in real numbers.
//
//   odometry_drift [MINUTES]     60 if not given; exit code 1 if our odometry misses a bar
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <functional>
#include <vector>

#include "common/kinematics/odometry.hpp"
#include "tests/common/kinematics/exact.hpp"

namespace astro {
namespace {

using tests::ExactPose;
using tests::Real;
using Int128 = __int128;

constexpr Real kBar_m = 1e-6L;  // in 60 minutes, in proportion for less
constexpr Real kSpeed_mps = 0.5L;

/// Way and heading of the robot's centre at a time.
struct Path {
  const char* name;
  Real start_rad;
  std::function<Real(Real)> heading_rad;  // turned since the start
};

const std::vector<Path> kPaths = {
    {"circle, R 0.5 m", 0, [](Real t_s) { return kSpeed_mps / 0.5L * t_s; }},
    {"straight, at 0 rad", 0, [](Real) { return Real{0}; }},
    {"straight, at 1 rad", 1, [](Real) { return Real{0}; }},
    {"slalom, +-0.6 rad", 0, [](Real t_s) { return 0.6L * std::sin(t_s); }},
};

/// What the encoders of a robot on the path count: whole counts, the rest stays for later.
class Encoders {
 public:
  Encoders(const Path& path, const ParameterSet& set) : path_(path), geometry_(set) {}

  struct Counts {
    int left, right;
  };
  Counts at(Real t_s) {
    const Real way_m = kSpeed_mps * t_s, aside_m = path_.heading_rad(t_s) * geometry_.base_m / 2;
    return {step(left_, (way_m - aside_m) / geometry_.left_m),
            step(right_, (way_m + aside_m) / geometry_.right_m)};
  }
  long long left() const { return left_; }
  long long right() const { return right_; }

 private:
  static int step(long long& seen, Real counts) {
    const long long now = std::llround(counts);
    const auto difference = static_cast<int>(now - seen);
    seen = now;
    return difference;
  }

  const Path& path_;
  tests::ExactGeometry geometry_;
  long long left_ = 0, right_ = 0;
};

/// A peer: heading summed, Euler steps with the heading after the step, all in one type.
template <class T>
struct Euler {
  T left_m, right_m, base_m, x_m = 0, y_m = 0, theta_rad = 0;
  void advance(int left, int right) {
    const T l = static_cast<T>(left) * left_m, r = static_cast<T>(right) * right_m;
    theta_rad += (r - l) / base_m;
    x_m += (r + l) / 2 * std::cos(theta_rad);
    y_m += (r + l) / 2 * std::sin(theta_rad);
  }
};

template <class T>
struct Arcs {
  T left_m, right_m, base_m, x_m = 0, y_m = 0, theta_rad = 0;
  void advance(int left, int right) {
    const T l = static_cast<T>(left) * left_m, r = static_cast<T>(right) * right_m;
    const T turn = (r - l) / base_m, half = turn / 2;
    const T chord = (r + l) / 2 * (half == 0 ? 1 : std::sin(half) / half);
    x_m += chord * std::cos(theta_rad + half);
    y_m += chord * std::sin(theta_rad + half);
    theta_rad += turn;
  }
};

/// `Peer<T>` with the geometry that T can hold.
template <template <class> class Peer, class T>
Peer<T> peer(const ParameterSet& set, Real start_rad) {
  const tests::ExactGeometry real(set);
  Peer<T> made{static_cast<T>(real.left_m), static_cast<T>(real.right_m), static_cast<T>(real.base_m)};
  made.theta_rad = static_cast<T>(start_rad);
  return made;
}

struct Error {
  Real most_m = 0;       // over the whole drive
  Real heading_rad = 0;  // at its end

  void see(Real x_m, Real y_m, Real theta_rad, const ExactPose& exact) {
    most_m = std::max(most_m, std::hypot(x_m - exact.x_m, y_m - exact.y_m));
    heading_rad = theta_rad - exact.theta_rad;
  }
};

struct Result {
  Error ours, in_float, in_double;
  Int128 rounding = 0;     // of our heading against the integer sum of the increments, 2^-64 turn
  Real explained_rad = 0;  // what the rounding of the two increments can do to the heading
};

Pose start_pose(Real start_rad) {
  Pose pose;
  pose.theta = Angle::from_raw(static_cast<std::uint64_t>(std::ldexp(start_rad / (2 * tests::kPi), 64)));
  return pose;
}

Result drive(const Path& path, int ticks) {
  const ParameterSet set = tests::calibrated_astro();
  const Geometry geometry = make_geometry(set);
  const Pose start = start_pose(path.start_rad);
  Odometry ours(geometry);
  ours.set_pose(start);
  auto in_float = peer<Euler, float>(set, path.start_rad);
  auto in_double = peer<Arcs, double>(set, path.start_rad);
  tests::ExactOdometry exact(set, tests::heading_rad(start));
  Encoders encoders(path, set);
  Result result;
  for (int tick = 1; tick <= ticks; ++tick) {
    const auto [left, right] = encoders.at(tick * 1e-3L);
    ours.advance(left, right, {});
    in_float.advance(left, right);
    in_double.advance(left, right);
    exact.advance(left, right);
    const Pose& pose = ours.pose();
    result.ours.see(tests::metres(pose.x), tests::metres(pose.y), tests::heading_rad(pose), exact.pose());
    result.in_float.see(in_float.x_m, in_float.y_m, in_float.theta_rad, exact.pose());
    result.in_double.see(in_double.x_m, in_double.y_m, in_double.theta_rad, exact.pose());
  }
  const Int128 turned = (Int128{ours.pose().turns} << 64) + ours.pose().theta.raw() - start.theta.raw();
  result.rounding = turned - (Int128{geometry.right.turn} * encoders.right() -
                              Int128{geometry.left.turn} * encoders.left());
  result.explained_rad =
      static_cast<Real>(std::llabs(encoders.left()) + std::llabs(encoders.right())) * tests::radians(1) / 2 +
      0x1p-62L * std::fabs(exact.pose().theta_rad);  // and long double
  return result;
}

bool report(const Path& path, int minutes) {
  const Result result = drive(path, minutes * 60'000);
  const Real bar_m = kBar_m * minutes / 60;
  const auto row = [&](const char* who, const Error& error) {
    fmt::print("{:20} {:22} {:14.3e} {:16.3e}\n", path.name, who, error.most_m, error.heading_rad);
  };
  row("ours (integers)", result.ours);
  row("double, exact arcs", result.in_double);
  row("float32, Euler", result.in_float);
  const bool good = result.ours.most_m <= bar_m && result.rounding == 0 &&
                    std::fabs(result.ours.heading_rad) <= result.explained_rad;
  fmt::print(
      "{:20} ours: {:.2g} of {:.2g} m; heading rounding {} (bar 0), increments explain {:.1e} rad: {}\n\n",
      "", result.ours.most_m, bar_m, static_cast<long long>(result.rounding), result.explained_rad,
      good ? "ok" : "MISSED");
  return good;
}

int run(int minutes) {
  fmt::print("{} min at 1 kHz, 0.5 m/s, the same integer counts for all\n", minutes);
  fmt::print("{:20} {:22} {:>14} {:>16}\n", "path", "odometry", "most error, m", "end heading, rad");
  bool good = true;
  for (const Path& path : kPaths) good = report(path, minutes) && good;
  return good ? 0 : 1;
}

}  // namespace
}  // namespace astro

int main(int argc, char** argv) {
  int minutes = 60;
  if (argc > 1) {
    const char* end = argv[1] + std::strlen(argv[1]);
    const auto [rest, error] = std::from_chars(argv[1], end, minutes);
    if (error != std::errc{} || rest != end || minutes < 1 || minutes > 600) {
      fmt::print(stderr, "odometry_drift: '{}' is not a number of minutes from 1 to 600\n", argv[1]);
      return 2;
    }
  }
  return astro::run(minutes);
}
