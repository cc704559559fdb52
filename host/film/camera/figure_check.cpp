#include "host/film/camera/figure_check.hpp"

#include <cmath>
#include <limits>

namespace astro::film {
namespace {

/// Removes the contribution of a measurement from the estimate that was found with it.
Measured without(const Measured& measured, const Measured& found) {
  constexpr double kRounding = 1e-5;  // of the variance: a smaller reduction is rounding only
  const double own = measured.sigma * measured.sigma, all = found.sigma * found.sigma;
  if (own - all < kRounding * own) return {found.value, std::numeric_limits<double>::infinity()};
  const double variance = all * own / (own - all);
  return {measured.value + (found.value - measured.value) * own / (own - all), std::sqrt(variance)};
}

}  // namespace

double FigureCheck::off() const {
  if (!std::isfinite(by_others.sigma)) return 0;
  return std::abs(measured.value - by_others.value) / std::hypot(measured.sigma, by_others.sigma);
}

std::vector<FigureCheck> check_figures(const Scene& scene, const Figures& figures,
                                       const Eigen::MatrixXd& covariance) {
  const std::vector<SceneParameter> parameters = parameters_of(scene, figures);
  std::vector<FigureCheck> all;
  const auto check = [&](FigureKind kind, std::size_t tape, const Measured& measured,
                         const SceneValue& value) {
    const Measured found = measured_by(scene, parameters, covariance, value);
    all.push_back({kind, tape, measured, found, without(measured, found)});
  };
  check(FigureKind::floor_side, 0, figures.floor_side_m, [](const Scene& s) { return s.floor_side_m; });
  check(FigureKind::robot_side, 0, figures.robot_side_m, [](const Scene& s) { return s.robot_side_m; });
  check(FigureKind::robot_height, 0, figures.robot_height_m, [](const Scene& s) { return s.robot_height_m; });
  for (std::size_t i = 0; i < figures.tapes.size(); ++i) {
    const Tape& tape = figures.tapes[i];
    if (!distance_between(scene, tape.from, tape.to)) continue;
    check(FigureKind::tape, i, tape.length_m,
          [&](const Scene& s) { return distance_between(s, tape.from, tape.to).value(); });
  }
  return all;
}

}  // namespace astro::film
