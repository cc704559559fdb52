#include "host/calibration/end_poses/line_scale.hpp"

#include <cmath>
#include <vector>

#include "host/base/error.hpp"
#include "host/base/order_statistics.hpp"
#include "host/base/pose2.hpp"
#include "host/base/text/numbers.hpp"
#include "host/calibration/end_poses/end_pose_problem.hpp"
#include "host/calibration/end_poses/robust_weight.hpp"

namespace astro::calibration {
namespace {

constexpr double kOdd = 0.03;

/// Standard deviation of the scale that one line gives.
double deviation_of(const LineEnd& line, const EndNoise& noise) {
  const double length_m2 = noise.reading_m * noise.reading_m + noise.slip_m / 2 * line.driven_m;
  return line.loaded_scale * std::sqrt(length_m2) / line.driven_m;
}

struct LineSums {
  double weights = 0, weighted = 0, information = 0;
  std::vector<Distance> distances;
};

LineSums sums_over(std::span<const LineEnd> lines, const EndNoise& noise, double scale, double scatter) {
  LineSums sums;
  for (const LineEnd& line : lines) {
    const double information = std::pow(deviation_of(line, noise), -2);
    sums.distances.push_back({information * std::pow(line.scale() - scale, 2)});
    const double weight = robust_weight(sums.distances.back(), scatter);
    sums.weights += weight * information;
    sums.weighted += weight * information * line.scale();
    sums.information += information;
  }
  return sums;
}

double median_scale(std::span<const LineEnd> lines) {
  std::vector<double> scales;
  for (const LineEnd& line : lines) scales.push_back(line.scale());
  return median_of(std::move(scales));
}

}  // namespace

double LineEnd::scale() const {
  // The direction of the chord is half the turn of the arc. If it points aside or back, this is no line, and no arc is assumed.
  const double half_turn = x_m > std::abs(y_m) ? std::atan2(y_m, x_m) : 0;
  return loaded_scale * std::hypot(x_m, y_m) / sinc(half_turn) / driven_m;
}

std::optional<LineScale> scale_of_lines(std::span<const LineEnd> lines, const EndNoise& noise) {
  if (lines.empty()) return std::nullopt;
  constexpr int kIterations = 100, kScatterIterations = 30;  // robust_fit.cpp says why
  double scale = median_scale(lines), scatter = 1;
  LineSums sums;
  for (int i = 0; i < kIterations; ++i) {
    sums = sums_over(lines, noise, scale, scatter);
    scale = sums.weighted / sums.weights;
    if (i < kScatterIterations) scatter = robust_scatter(sums.distances, 1);
  }
  if (!(scale > 0.5 && scale < 2))
    throw Error("the measured lines give a scale of " + to_text(scale) +
                    ", and a robot has one between 0.5 and 2: check the units",
                EndPoseProblem::implausible_scale, {to_text(scale)});
  return LineScale{scale, std::sqrt(kLossOfNormal * scatter / sums.information),
                   static_cast<int>(lines.size())};
}

bool is_odd(const LineEnd& line, double expected) {
  return !(line.x_m > 0) || !(std::abs(line.scale() / expected - 1) < kOdd);
}

}  // namespace astro::calibration
