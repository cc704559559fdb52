#include "host/import/wheels/lost_rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "host/base/order_statistics.hpp"

namespace astro::importing {
namespace {

constexpr double kEvenStep = 0.2, kLongerStep = 1.5;  // of the usual step
constexpr double kMostlyEven = 0.75;                  // of all steps
constexpr double kHeldTravel = 0.75;                  // of the expected travel; more: the logger was late
constexpr std::size_t kFewestRows = 20;

struct Step {
  double time_ns = 0, travel = 0;  // of both wheels together
};

std::vector<Step> steps_of(std::span<const WheelSample> sums) {
  std::vector<Step> steps;
  for (std::size_t i = 1; i < sums.size(); ++i)
    steps.push_back(
        {static_cast<double>(sums[i].time_ns - sums[i - 1].time_ns),
         std::abs(sums[i].left - sums[i - 1].left) + std::abs(sums[i].right - sums[i - 1].right)});
  return steps;
}

double usual_ns(const std::vector<Step>& steps) {
  std::vector<double> times_ns;
  for (const Step& step : steps) times_ns.push_back(step.time_ns);
  return median_of(std::move(times_ns));
}

}  // namespace

std::optional<LostRows> find_lost_rows(std::span<const WheelSample> sums) {
  if (sums.size() < kFewestRows) return std::nullopt;
  const std::vector<Step> steps = steps_of(sums);
  const double usual = usual_ns(steps);
  const auto even = [&](const Step& step) { return std::abs(step.time_ns - usual) < kEvenStep * usual; };
  const auto evenly = std::count_if(steps.begin(), steps.end(), even);
  if (static_cast<double>(evenly) < kMostlyEven * static_cast<double>(steps.size())) return std::nullopt;
  LostRows lost;
  double expected = 0, held = 0, whole = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    whole += steps[i].travel;
    if (i == 0 || i + 1 == steps.size() || steps[i].time_ns < kLongerStep * usual) continue;
    if (!even(steps[i - 1]) || !even(steps[i + 1])) continue;
    expected += (steps[i - 1].travel + steps[i + 1].travel) / 2 * steps[i].time_ns / usual;
    held += steps[i].travel;
    if (lost.steps++ == 0) lost.first_ns = sums[i + 1].time_ns;
  }
  if (!(expected > 0) || held > kHeldTravel * expected) return std::nullopt;
  lost.part = (expected - held) / (whole + expected - held);
  return lost;
}

}  // namespace astro::importing
