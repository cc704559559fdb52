#include "host/calibration/wall/wall_headings.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace astro::calibration {
namespace {

constexpr double kWheelbaseKnown = 0.05, kRatioKnown = 0.02;

Eigen::RowVector2d row_of(const WheelTravel& travel) { return {travel.right_m, -travel.left_m}; }

/// Of the loaded factors.
Eigen::Vector2d loaded_a(const WheelFactors& loaded) {
  return {loaded.c_r / loaded.b_m, loaded.c_l / loaded.b_m};
}

double slip_variance(const WheelTravel& travel, double a, double K_m) {
  return K_m * a * a * travel.path_m();
}

/// Sums of the normal equations, series after series.
struct Normal {
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  double square = 0, log_determinant = 0;

  void add(const Eigen::MatrixX2d& rows, const Eigen::VectorXd& values, const Eigen::MatrixXd& covariance) {
    const Eigen::LLT<Eigen::MatrixXd> llt(covariance);
    const Eigen::MatrixX2d x = llt.matrixL().solve(rows);
    const Eigen::VectorXd y = llt.matrixL().solve(values);
    information += x.transpose() * x;
    right += x.transpose() * y;
    square += y.squaredNorm();
    log_determinant += 2 * llt.matrixLLT().diagonal().array().log().sum();
  }
};

void add_knowledge(Normal& normal, const Eigen::Vector2d& loaded) {
  const double a = loaded.mean();
  Eigen::MatrixX2d rows(2, 2);
  rows << 0.5, 0.5, 1, -1;
  const Eigen::Vector2d known(kWheelbaseKnown * a, kRatioKnown * a);
  normal.add(rows, rows * loaded, known.cwiseAbs2().asDiagonal());
}

void add_series(Normal& normal, const Stretch* begin, const Stretch* end, double a, const WallNoise& noise) {
  const auto count = static_cast<Eigen::Index>(end - begin);
  Eigen::MatrixX2d rows(count, 2);
  Eigen::VectorXd values(count);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(count, count);
  const double squaring = noise.squaring_rad * noise.squaring_rad;
  for (Eigen::Index i = 0; i < count; ++i) {
    rows.row(i) = row_of(begin[i].travel);
    values[i] = begin[i].turned_rad;
    covariance(i, i) = slip_variance(begin[i].travel, a, noise.K_m) + 2 * squaring;
    if (i > 0) covariance(i, i - 1) = covariance(i - 1, i) = -squaring;
  }
  normal.add(rows, values, covariance);
}

/// Penalty of a number that is usually `usual`, within a factor of `factor`, in log-likelihood.
double knowledge(double value, double usual, double factor) {
  const double off = std::log(value / usual) / std::log(factor);
  return -off * off / 2;
}

double worth(const std::vector<Stretch>& stretches, const WheelFactors& loaded, const WallNoise& noise,
             const WallNoise& usual) {
  constexpr double kSlipWithin = 2, kSquaringWithin = 3;
  return fit_headings(stretches, loaded, noise).log_likelihood +
         knowledge(noise.K_m, usual.K_m, kSlipWithin) +
         knowledge(noise.squaring_rad, usual.squaring_rad, kSquaringWithin);
}

}  // namespace

HeadingFit fit_headings(const std::vector<Stretch>& stretches, const WheelFactors& loaded,
                        const WallNoise& noise) {
  const Eigen::Vector2d a0 = loaded_a(loaded);
  Normal normal;
  add_knowledge(normal, a0);
  for (std::size_t begin = 0, end = 0; begin < stretches.size(); begin = end) {
    do ++end;
    while (end < stretches.size() && !stretches[end].first);
    add_series(normal, stretches.data() + begin, stretches.data() + end, a0.mean(), noise);
  }
  HeadingFit fit;
  fit.covariance = normal.information.inverse();
  fit.a = fit.covariance * normal.right;
  fit.chi_square = normal.square - fit.a.dot(normal.right);
  fit.stretches = static_cast<int>(stretches.size());
  for (const Stretch& stretch : stretches)
    fit.residual_rad.push_back(stretch.turned_rad - row_of(stretch.travel).dot(fit.a));
  fit.log_likelihood =
      -(normal.log_determinant + std::log(normal.information.determinant()) + fit.chi_square) / 2;
  return fit;
}

double heading_variance(const WheelTravel& travel, const HeadingFit& fit, const WallNoise& noise) {
  const Eigen::RowVector2d row = row_of(travel);
  return slip_variance(travel, fit.a.mean(), noise.K_m) + 2 * noise.squaring_rad * noise.squaring_rad +
         (row * fit.covariance * row.transpose()).value();
}

// The best of a grid in both logarithms, then of finer grids about it.
WallNoise noise_of(const std::vector<Stretch>& stretches, const WheelFactors& loaded,
                   const WallNoise& usual) {
  WallNoise best = usual;
  double best_worth = worth(stretches, loaded, best, usual);
  for (const double step : {2.0, 1.4, 1.15, 1.05}) {
    const WallNoise middle = best;
    for (int i = -3; i <= 3; ++i) {
      for (int j = -3; j <= 3; ++j) {
        WallNoise noise = middle;
        noise.K_m *= std::pow(step, i);
        noise.squaring_rad *= std::pow(step, j);
        const double now = worth(stretches, loaded, noise, usual);
        if (!(now > best_worth)) continue;
        best = noise;
        best_worth = now;
      }
    }
  }
  return best;
}

}  // namespace astro::calibration
