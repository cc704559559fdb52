#include "host/truth/source/plausibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "host/base/pose2.hpp"
#include "host/base/text/degrees.hpp"

namespace astro::truth {
namespace {

constexpr double kMostOfDistance = 0.25, kLeast_m = 0.2, kMost_rad = std::numbers::pi / 3;

double length_m(const recording::Run& run) {
  double length = 0;
  for (std::size_t i = 1; i < run.odometry.size(); ++i)
    length += std::hypot(run.odometry[i].x_m - run.odometry[i - 1].x_m,
                         run.odometry[i].y_m - run.odometry[i - 1].y_m);
  return length;
}

double distance_m(const Pose2& a, const Pose2& b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

/// A pose that may have been meant, and its wording.
struct Guess {
  Pose2 pose;
  std::string text;
};

constexpr std::array kShifts{1e-3, 1e-2, 1e-1, 1e1, 1e2, 1e3};

std::vector<Guess> one_number(const Pose2& typed) {
  std::vector<Guess> list;
  for (const double shift : kShifts) {
    const double x_m = shift * typed.x_m, y_m = shift * typed.y_m;
    list.push_back({{x_m, typed.y_m}, fmt::format("x = {:.4g} m", x_m)});
    list.push_back({{typed.x_m, y_m}, fmt::format("y = {:.4g} m", y_m)});
  }
  list.push_back({{-typed.x_m, typed.y_m}, fmt::format("x = {:.4g} m", -typed.x_m)});
  list.push_back({{typed.x_m, -typed.y_m}, fmt::format("y = {:.4g} m", -typed.y_m)});
  return list;
}

std::vector<Guess> both_numbers(const Pose2& typed) {
  std::vector<Guess> list;
  const auto add = [&](double x_m, double y_m) {
    list.push_back({{x_m, y_m}, fmt::format("x = {:.4g} m, y = {:.4g} m", x_m, y_m)});
  };
  for (const double shift : kShifts) add(shift * typed.x_m, shift * typed.y_m);
  add(typed.y_m, typed.x_m);
  return list;
}

/// "; x = 1.2 m would fit": the change of one number that brings the end closest to that of odometry, or of both where one is
/// not enough to come within `most_m`.
std::string likely_meant(const Pose2& typed, const Pose2& odometry, double most_m) {
  for (const std::vector<Guess>& guesses : {one_number(typed), both_numbers(typed)}) {
    const Guess& best = *std::ranges::min_element(
        guesses, {}, [&](const Guess& guess) { return distance_m(guess.pose, odometry); });
    if (distance_m(best.pose, odometry) < most_m) return "; " + best.text + " would fit";
  }
  return "";
}

}  // namespace

std::string implausible_end(const recording::Run& run, const recording::TruthSample& start,
                            const recording::TruthSample& end) {
  if (run.odometry.empty()) return "";
  const Pose2 odometry = pose_of(run.odometry.front()).between(pose_of(run.odometry.back()));
  const Pose2 measured = pose_of(start).between(pose_of(end));
  const double driven_m = length_m(run);
  const double off_m = distance_m(measured, odometry),
               most_m = std::max(kLeast_m, kMostOfDistance * driven_m);
  if (!(off_m <= most_m))
    return fmt::format(
        "this end is {:.4g} m from where odometry ends, after a run of {:.4g} m, as if it were in another "
        "unit{}.",
        off_m, driven_m, likely_meant(measured, odometry, most_m));
  const double turned_rad = wrapped_rad(measured.theta_rad - odometry.theta_rad);
  if (std::abs(turned_rad) > kMost_rad)
    return fmt::format(
        "this heading is {:.0f} degrees from that of odometry, as if it were in another unit or not "
        "counter-clockwise.",
        degrees(std::abs(turned_rad)));
  return "";
}

}  // namespace astro::truth
