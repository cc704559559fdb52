#include "host/truth/film/camera/figure_check.hpp"

#include <cmath>
#include <functional>
#include <limits>

namespace astro::film {
namespace {

using Value = std::function<double(const Scene&)>;

Measured found_value(const Scene& scene, const std::vector<SceneParameter>& parameters,
                     const Eigen::MatrixXd& covariance, const Value& value) {
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(covariance.rows());
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    Eigen::VectorXd change = Eigen::VectorXd::Zero(covariance.rows());
    const auto at = static_cast<Eigen::Index>(i);
    change[at] = parameters[i].step;
    gradient[at] = (value(moved(scene, change)) - value(moved(scene, -change))) / (2 * parameters[i].step);
  }
  return {value(scene), std::sqrt(std::max(0.0, gradient.dot(covariance * gradient)))};
}

/// Takes a measurement out of what was found with it.
Measured without(const Measured& measured, const Measured& found) {
  constexpr double kLeast = 1e-5;  // of the variance: less is rounding, and nothing else shows the figure
  const double own = measured.sigma * measured.sigma, all = found.sigma * found.sigma;
  if (own - all < kLeast * own) return {found.value, std::numeric_limits<double>::infinity()};
  const double variance = all * own / (own - all);
  return {measured.value + (found.value - measured.value) * own / (own - all), std::sqrt(variance)};
}

}  // namespace

double FigureCheck::off() const {
  if (!std::isfinite(by_others.sigma)) return 0;
  return std::abs(measured.value - by_others.value) / std::hypot(measured.sigma, by_others.sigma);
}

std::optional<double> distance_between(const Scene& scene, int from, int to) {
  const auto tag = [&](int id) -> const FloorTag* {
    for (const FloorTag& one : scene.tags)
      if (one.id == id) return &one;
    return nullptr;
  };
  const FloorTag *a = tag(from), *b = tag(to);
  if (a == nullptr || b == nullptr) return std::nullopt;
  return std::hypot(b->x_m - a->x_m, b->y_m - a->y_m);
}

std::vector<FigureCheck> check_figures(const Scene& scene, const Figures& figures,
                                       const Eigen::MatrixXd& covariance) {
  const std::vector<SceneParameter> parameters = parameters_of(scene, figures);
  std::vector<FigureCheck> all;
  const auto check = [&](FigureKind kind, std::size_t tape, const Measured& measured, const Value& value) {
    const Measured found = found_value(scene, parameters, covariance, value);
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
