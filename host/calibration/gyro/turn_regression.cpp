#include "host/calibration/gyro/turn_regression.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace astro::calibration {
namespace {

constexpr double kUnknownPhase_rad2 = 1e4;
constexpr double kUnknownBias_rad2ps2 = 0.09;  // no sensor is off by 17 degrees a second
constexpr double kOutlier = 6;
constexpr int kMostRounds = 5;
constexpr std::array kNoises{&TurnNoise::gyro_rad2ps, &TurnNoise::bias_rad2ps3, &TurnNoise::slip_rad2pm,
                             &TurnNoise::reading_rad2};

/// The response and each regressor side by side: the filter is linear and has the same gains for all of them.
using Columns = Eigen::Matrix<double, kTurnColumns + 1, 1>;

Columns columns_of(const TurnSample& sample) {
  Columns columns;
  columns << sample.response_rad, sample.regressors;
  return columns;
}

struct Innovation {
  Columns columns;
  double variance = 0;
};

/// The filter at the end of a drive.
struct End {
  Columns bias = Columns::Zero();
  double bias_variance = 0;
};

/// Calls `take(index, innovation)` for every sample but those that begin a phase, which say nothing.
template <class Take>
End filter(std::span<const TurnSample> samples, const TurnNoise& noise, Take take) {
  Columns phase = Columns::Zero(), bias = Columns::Zero();
  double p_pp = kUnknownPhase_rad2, p_pb = 0, p_bb = kUnknownBias_rad2ps2;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const bool begins = i == 0 || samples[i].new_phase;
    if (i > 0) {
      const double dt_s = samples[i].time_s - samples[i - 1].time_s;
      phase += dt_s * bias;
      p_pp += dt_s * (2 * p_pb + dt_s * p_bb) + dt_s * noise.gyro_rad2ps +
              noise.slip_rad2pm * (samples[i].path_m - samples[i - 1].path_m);
      p_pb += dt_s * p_bb;
      p_bb += dt_s * noise.bias_rad2ps3;
    }
    const Columns now = columns_of(samples[i]);
    if (begins) {
      phase = now;  // exact but for the reading error, so that no large variance is subtracted from another
      p_pp = noise.reading_rad2;
      p_pb = 0;
      continue;
    }
    const Innovation innovation{now - phase, p_pp + noise.reading_rad2};
    take(i, innovation);
    const double gain_p = p_pp / innovation.variance, gain_b = p_pb / innovation.variance;
    phase += gain_p * innovation.columns;
    bias += gain_b * innovation.columns;
    p_bb -= gain_b * p_pb;
    p_pb -= gain_p * p_pb;
    p_pp -= gain_p * p_pp;
  }
  return {bias, p_bb};
}

struct Fit {
  TurnVector x = TurnVector::Zero();
  TurnMatrix covariance = TurnMatrix::Zero();
  double minus_log_likelihood = 0, chi_square = 0;
  int samples = 0;
};

Fit fit_for(std::span<const std::vector<TurnSample>> drives, const TurnVector& information,
            const TurnNoise& noise) {
  TurnMatrix matrix = information.asDiagonal();
  TurnVector right = TurnVector::Zero();
  double squares = 0, logs = 0;
  Fit fit;
  for (const std::vector<TurnSample>& drive : drives)
    filter(drive, noise, [&](std::size_t, const Innovation& innovation) {
      const TurnVector regressors = innovation.columns.tail<kTurnColumns>();
      const double response = innovation.columns[0], weight = 1 / innovation.variance;
      matrix += weight * regressors * regressors.transpose();
      right += weight * response * regressors;
      squares += weight * response * response;
      logs += std::log(innovation.variance);
      ++fit.samples;
    });
  fit.covariance = matrix.inverse();
  fit.x = fit.covariance * right;
  fit.chi_square = squares - right.dot(fit.x);
  // Restricted (REML): noise is not taken for smaller because the coefficients follow it, which counts with a few samples.
  fit.minus_log_likelihood = (logs + std::log(matrix.determinant()) + fit.chi_square) / 2;
  return fit;
}

double penalty(const TurnNoise& noise, const TurnNoisePrior& prior) {
  double sum = 0;
  for (const auto member : kNoises)
    if (prior.log_deviation.*member > 0)
      sum += std::pow(std::log(noise.*member / prior.middle.*member) / prior.log_deviation.*member, 2) / 2;
  return sum;
}

/// A search along one logarithm after the other, in steps that become smaller.
TurnNoise likeliest_noise(std::span<const std::vector<TurnSample>> drives, const TurnVector& information,
                          TurnNoise noise, const TurnNoisePrior& prior) {
  constexpr double kFirstStep = 2, kLastStep = 0.04;
  const auto cost = [&](const TurnNoise& at) {
    return fit_for(drives, information, at).minus_log_likelihood + penalty(at, prior);
  };
  double best = cost(noise);
  for (double step = kFirstStep; step > kLastStep;) {
    bool better = false;
    for (const auto member : kNoises) {
      if (!(prior.log_deviation.*member > 0)) continue;
      for (const double factor : {std::exp(step), std::exp(-step)}) {
        TurnNoise other = noise;
        other.*member *= factor;
        const double found = cost(other);
        if (!(found < best)) continue;
        best = found;
        noise = other;
        better = true;
        break;
      }
    }
    if (!better) step /= 2;
  }
  return noise;
}

/// Begins a phase where the gyro and the reference part. Returns whether there was a new one.
bool mark_outliers(std::span<std::vector<TurnSample>> drives, const TurnVector& x, const TurnNoise& noise) {
  bool any = false;
  for (std::vector<TurnSample>& drive : drives) {
    std::vector<std::size_t> outliers;
    filter(drive, noise, [&](std::size_t i, const Innovation& innovation) {
      const double off = innovation.columns[0] - x.dot(innovation.columns.tail<kTurnColumns>());
      // The filter follows an outlier, and the samples behind it seem to be off as well.
      if (off * off > kOutlier * kOutlier * innovation.variance &&
          (outliers.empty() || outliers.back() + 1 < i))
        outliers.push_back(i);
    });
    for (const std::size_t i : outliers) drive[i].new_phase = true;
    any = any || !outliers.empty();
  }
  return any;
}

}  // namespace

TurnRegression regress_turns(std::span<std::vector<TurnSample>> drives, const TurnVector& information,
                             const TurnNoisePrior& prior) {
  TurnRegression found;
  found.noise = prior.middle;
  Fit fit;
  for (int round = 0; round < kMostRounds; ++round) {
    found.noise = likeliest_noise(drives, information, found.noise, prior);
    fit = fit_for(drives, information, found.noise);
    if (!mark_outliers(drives, fit.x, found.noise)) break;
  }
  found.x = fit.x;
  found.covariance = fit.covariance;
  found.chi_square = fit.chi_square;
  found.degrees_of_freedom = fit.samples - kTurnColumns;
  for (const std::vector<TurnSample>& drive : drives) {
    const End end = filter(drive, found.noise, [](std::size_t, const Innovation&) {});
    found.drifts.push_back(
        {end.bias[0] - fit.x.dot(end.bias.tail<kTurnColumns>()), std::sqrt(end.bias_variance)});
  }
  return found;
}

}  // namespace astro::calibration
