// How many scans of 360 beams are matched in a second on one core, each as a new keyframe with starts that are off
// by up to 10 cm and 6 degrees.
//
//   scan_matching     exit code 1 if fewer than 100 a second
#include <fmt/format.h>

#include <chrono>
#include <random>

#include "host/lidar/pair_match.hpp"
#include "tests/host/lidar/synthetic_room.hpp"

int main() {
  using namespace astro;
  using namespace astro::lidar;
  constexpr int kPairs = 400;
  constexpr double kBar_per_s = 100;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(-2, 2), turn(-3, 3), step(-0.4, 0.4), off(-0.1, 0.1);
  std::vector<std::pair<Scan, Scan>> pairs;
  std::vector<Pose2> motions;
  for (int i = 0; i < kPairs; ++i) {
    Scanner scanner;
    scanner.place = {place(random), place(random), turn(random)};
    const auto scan = [&] {
      return SyntheticDrive(furnished_room(), {{1, 1, kNominalBase_m}, 0}, scanner, 1).scan_at(0, random);
    };
    const Scan first = scan();
    motions.push_back({step(random), step(random), step(random)});
    scanner.place = scanner.place * motions.back();
    pairs.emplace_back(first, scan());
  }
  int matched = 0;
  const auto began = std::chrono::steady_clock::now();
  for (int i = 0; i < kPairs; ++i) {
    const NearestPoints reference(surface_of(pairs[static_cast<std::size_t>(i)].first, {}));
    const std::vector<SurfacePoint> points = surface_of(pairs[static_cast<std::size_t>(i)].second, {});
    const Pose2& motion = motions[static_cast<std::size_t>(i)];
    const Pose2 start{motion.x_m + off(random), motion.y_m + off(random), motion.theta_rad + off(random)};
    if (trusted_match(reference, points, start)) ++matched;
  }
  const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  const double per_s = kPairs / took_s;
  fmt::print("{} pairs of scans of 360 beams, {} matched: {:.0f} a second (bar {:.0f})\n", kPairs, matched,
             per_s, kBar_per_s);
  return per_s >= kBar_per_s && matched > kPairs / 2 ? 0 : 1;
}
