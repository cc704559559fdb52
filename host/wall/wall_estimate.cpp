#include "host/wall/wall_estimate.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "host/base/text/degrees.hpp"

namespace astro::wall {
namespace {

constexpr double kWheelbaseKnown = 0.05, kRatioKnown = 0.02;

Eigen::RowVector2d row_of(const WheelTravel& travel) { return {travel.right_m, -travel.left_m}; }

/// a_R and a_L of the loaded factors.
Eigen::Vector2d loaded_a(const calibration::WheelFactors& loaded) {
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

/// The logarithm of the prior of a number that is usually `usual`, within a factor of `factor`.
double knowledge(double value, double usual, double factor) {
  const double off = std::log(value / usual) / std::log(factor);
  return -off * off / 2;
}

/// Of a fit for `noise`: its posterior, as a logarithm.
double worth(const HeadingFit& fit, const WallNoise& noise, const WallNoise& usual) {
  constexpr double kSlipWithin = 2, kSquaringWithin = 3;
  return fit.log_likelihood + knowledge(noise.K_m, usual.K_m, kSlipWithin) +
         knowledge(noise.squaring_rad, usual.squaring_rad, kSquaringWithin);
}

constexpr double kTurn_rad = 2 * std::numbers::pi;

/// The whole turns of a stretch: the number nearest to that by the fit of the stretches before, so that stretches with a few
/// turns make those with many turns unambiguous.
double whole_turns_rad(const WheelTravel& travel, const HeadingFit& before) {
  const double turned = before.a[0] * travel.right_m - before.a[1] * travel.left_m;
  return kTurn_rad * std::round(turned / kTurn_rad);
}

std::vector<Stretch> stretches_of(const WallDrive& drive, const calibration::WheelFactors& loaded,
                                  const WallNoise& noise) {
  std::vector<Stretch> stretches;
  for (const WallSeries& series : drive) {
    for (std::size_t i = 1; i < series.squarings.size(); ++i) {
      const WheelTravel travel = series.squarings[i] - series.squarings[i - 1];
      const HeadingFit before = fit_headings(stretches, loaded, noise);
      stretches.push_back({travel, whole_turns_rad(travel, before), i == 1});
    }
  }
  return stretches;
}

/// E_d = a_R / a_L and b / S = 2 / (a_R + a_L), with the derivatives of their logarithms.
Eigen::Matrix2d jacobian_of_ratios(const Eigen::Vector2d& a) {
  const double sum = a.sum();
  return (Eigen::Matrix2d() << 1 / a[0], -1 / a[1], -1 / sum, -1 / sum).finished();
}

/// c_R = 2 S E / (1 + E), c_L = 2 S / (1 + E), b = S B by ln E, ln B and ln S.
Eigen::Matrix3d jacobian_of_factors(const calibration::WheelFactors& f, double E_d) {
  const double right = 1 / (1 + E_d), left = -E_d / (1 + E_d);
  return (Eigen::Matrix3d() << f.c_r * right, 0, f.c_r, f.c_l * left, 0, f.c_l, 0, f.b_m, f.b_m).finished();
}

/// The noise for safety limits: K is at least the usual one, because a few stretches on which the wheels happened to slip
/// little do not show that they never slip more.
WallNoise cautious(WallNoise noise) {
  noise.K_m = std::max(noise.K_m, WallNoise{}.K_m);
  return noise;
}

/// The fit for `likeliest`, with a and its covariance averaged over all noise that the drive does not rule out. Some twenty stretches
/// know K and the error of a squaring so poorly that the fit for the likeliest alone would seem better than it is.
HeadingFit averaged_fit(const std::vector<Stretch>& stretches, const calibration::WheelFactors& loaded,
                        const WallNoise& usual, const WallNoise& likeliest) {
  constexpr int kSteps = 3;
  constexpr double kStep = 1.5;
  HeadingFit average = fit_headings(stretches, loaded, likeliest);
  const double best = worth(average, likeliest, usual);
  double weights = 0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  for (int i = -kSteps; i <= kSteps; ++i) {
    for (int j = -kSteps; j <= kSteps; ++j) {
      WallNoise noise = likeliest;
      noise.K_m *= std::pow(kStep, i);
      noise.squaring_rad *= std::pow(kStep, j);
      const HeadingFit fit = fit_headings(stretches, loaded, noise);
      const double weight = std::exp(worth(fit, noise, usual) - best);
      const Eigen::Vector2d off = fit.a - average.a;
      weights += weight;
      sum += weight * off;
      squares += weight * (fit.covariance + off * off.transpose());
    }
  }
  const Eigen::Vector2d off = sum / weights;
  average.a += off;
  average.covariance = squares / weights - off * off.transpose();
  for (std::size_t i = 0; i < stretches.size(); ++i)
    average.residual_rad[i] -= row_of(stretches[i].travel).dot(off);
  return average;
}

}  // namespace

HeadingFit fit_headings(const std::vector<Stretch>& stretches, const calibration::WheelFactors& loaded,
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

// Takes the best point of a grid in both logarithms, then of finer grids about it.
WallNoise noise_of(const std::vector<Stretch>& stretches, const calibration::WheelFactors& loaded,
                   const WallNoise& usual) {
  WallNoise best = usual;
  const auto worth_of = [&](const WallNoise& noise) {
    return worth(fit_headings(stretches, loaded, noise), noise, usual);
  };
  double best_worth = worth_of(best);
  for (const double step : {2.0, 1.4, 1.15, 1.05}) {
    const WallNoise middle = best;
    for (int i = -3; i <= 3; ++i) {
      for (int j = -3; j <= 3; ++j) {
        WallNoise noise = middle;
        noise.K_m *= std::pow(step, i);
        noise.squaring_rad *= std::pow(step, j);
        const double now = worth_of(noise);
        if (!(now > best_worth)) continue;
        best = noise;
        best_worth = now;
      }
    }
  }
  return best;
}

WallEstimate estimate_wall(const WallDrive& drive, const calibration::WheelFactors& loaded,
                           const WallNoise& usual) {
  WallEstimate result;
  result.stretches = stretches_of(drive, loaded, usual);
  const bool shows_noise = result.stretches.size() >= 3;
  result.noise = shows_noise ? noise_of(result.stretches, loaded, usual) : usual;
  result.headings = shows_noise ? averaged_fit(result.stretches, loaded, usual, result.noise)
                                : fit_headings(result.stretches, loaded, result.noise);
  const Eigen::Vector2d& a = result.headings.a;
  result.E_d = a[0] / a[1];
  result.b_per_scale_m = 2 / a.sum();

  calibration::WheelFactors& factors = result.factors = loaded;
  const auto with_scale = [&](double scale) {
    factors.c_r = 2 * scale * result.E_d / (1 + result.E_d);
    factors.c_l = 2 * scale / (1 + result.E_d);
    factors.b_m = scale * result.b_per_scale_m;
  };
  with_scale((loaded.c_r + loaded.c_l) / 2);
  result.scale = scale_of_gaps(drive, factors, result.noise);
  if (result.scale) with_scale(result.scale->scale);

  const Eigen::Matrix2d jacobian = jacobian_of_ratios(a);
  const Eigen::Matrix2d ratios = jacobian * result.headings.covariance * jacobian.transpose();
  result.se = {result.E_d * std::sqrt(ratios(0, 0)), std::sqrt(ratios(1, 1)),
               result.scale ? result.scale->se : std::numeric_limits<double>::quiet_NaN()};
  Eigen::Matrix3d logarithms = Eigen::Matrix3d::Zero();
  logarithms.topLeftCorner<2, 2>() = ratios;
  if (result.scale) logarithms(2, 2) = std::pow(result.scale->se / result.scale->scale, 2);
  const Eigen::Matrix3d to_factors = jacobian_of_factors(factors, result.E_d);
  result.covariance = to_factors * logarithms * to_factors.transpose();
  return result;
}

std::optional<SquaringDoubt> doubt_about_squaring(const WallSeries& series, const WallEstimate& expected,
                                                  double further_m) {
  using Kind = SquaringDoubt::Kind;
  constexpr double kDeviations = 6, kLeastAllowed_rad = 0.02, kMostAllowed_rad = 0.6, kLeastAllowed_m = 0.015;
  if (series.squarings.size() < 2) return std::nullopt;
  const WallNoise noise = cautious(expected.noise);
  const WheelTravel travel = series.squarings.back() - series.squarings[series.squarings.size() - 2];
  const Eigen::Vector2d& a = expected.headings.a;
  const double off_rad = std::remainder(a[0] * travel.right_m - a[1] * travel.left_m, kTurn_rad);
  const double variance = heading_variance(travel, expected.headings, noise);
  const double allowed_rad =
      std::clamp(kDeviations * std::sqrt(variance), kLeastAllowed_rad, kMostAllowed_rad);
  if (std::abs(off_rad) > allowed_rad)
    return SquaringDoubt{
        Kind::turned, off_rad, allowed_rad,
        fmt::format("by its wheels the robot has turned {:.1f} degrees {} than whole turns since it was "
                    "flush before, "
                    "where {:.1f} would be usual",
                    degrees(std::abs(off_rad)), off_rad > 0 ? "more" : "less", degrees(allowed_rad))};
  // Allows for slip along the path, and for lines that the robot drove askew, each of them twice at the most.
  const double allowed_m = kLeastAllowed_m + kDeviations * std::sqrt(noise.K_m * travel.path_m() / 4) +
                           travel.path_m() / 4 * variance;
  if (std::abs(further_m) <= allowed_m) return std::nullopt;
  return SquaringDoubt{
      further_m < 0 ? Kind::too_early : Kind::too_late, further_m, allowed_m,
      fmt::format("by its wheels the robot was flush {:.0f} mm {} the wall of before, where {:.0f} "
                  "would be usual",
                  1000 * std::abs(further_m), further_m < 0 ? "in front of" : "behind", 1000 * allowed_m)};
}

double approach_margin_m(const WheelTravel& way, double half_width_m, const WallEstimate& expected,
                         double at_least_m) {
  constexpr double kSigmas = 3;
  const WallNoise noise = cautious(expected.noise);
  const double slip_m = std::sqrt(noise.K_m * way.path_m() / 4);
  const double corner_m = half_width_m * std::sqrt(heading_variance(way, expected.headings, noise));
  return at_least_m + kSigmas * std::hypot(slip_m, corner_m);
}

}  // namespace astro::wall
