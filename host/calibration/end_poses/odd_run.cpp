#include "host/calibration/end_poses/odd_run.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "host/base/degrees.hpp"
#include "host/calibration/motion/median.hpp"

namespace astro::calibration {
namespace {

constexpr double kFar = 5, kLeastFarOfSide = 0.025, kLeastFar_rad = 0.026;

struct Coordinate {
  const char* name;
  double EndPose::*value;
};
constexpr std::array kCoordinates{Coordinate{"x", &EndPose::x_m}, Coordinate{"y", &EndPose::y_m},
                                  Coordinate{"theta", &EndPose::theta_rad}};

struct Others {
  double median = 0, reach = 0;  // reach: largest distance from the median
};

std::optional<Others> others_than(std::span<const EndPose> runs, std::size_t index, double EndPose::*value) {
  std::vector<double> values;
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (i != index && std::isfinite(runs[i].*value)) values.push_back(runs[i].*value);
  if (values.size() < 2) return std::nullopt;
  Others others{median_of(values), 0};
  for (const double one : values) others.reach = std::max(others.reach, std::abs(one - others.median));
  return others;
}

/// Whether it would be five times closer to the others with its decimal point moved.
bool is_shifted(double value, const Others& others) {
  for (const double shift : {1e-3, 1e-2, 1e-1, 1e1, 1e2, 1e3})
    if (std::abs(shift * value - others.median) * kFar < std::abs(value - others.median)) return true;
  return false;
}

}  // namespace

std::optional<OddRun> mistyped_run(std::span<const EndPose> runs, double side_m) {
  std::optional<OddRun> oddest;
  double most = 1;
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (const Coordinate& coordinate : kCoordinates) {
      const double value = runs[i].*coordinate.value;
      const auto others = others_than(runs, i, coordinate.value);
      if (!std::isfinite(value) || !others || !is_shifted(value, *others)) continue;
      // If the others scatter about 0, every number comes closer to them with its decimal point moved.
      const bool scatter = std::abs(others->median) <= 2 * others->reach;
      const double least =
          (scatter ? 2 : 1) *
          (coordinate.value == &EndPose::theta_rad ? kLeastFar_rad : kLeastFarOfSide * side_m);
      const double far = std::abs(value - others->median) / std::max(kFar * others->reach, least);
      if (far <= most) continue;
      most = far;
      oddest = OddRun{i, coordinate.name, value, others->median};
    }
  return oddest;
}

std::string described(const OddRun& odd) {
  const bool angle = std::string_view(odd.coordinate) == "theta";
  const auto shown = [&](double value) { return angle ? degrees(value) : value; };
  const char* unit = angle ? "degrees" : "m";
  return fmt::format("{} = {:.4g} {}, and {:.4g} {} in the others, as if its decimal point were misplaced",
                     odd.coordinate, shown(odd.value), unit, shown(odd.others), unit);
}

}  // namespace astro::calibration
