#include "host/calibration/likelihood/normal_equations.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

namespace astro::calibration {
namespace {

using Own = Eigen::Matrix<double, kOwn, kOwn>;
using OwnVector = Eigen::Matrix<double, kOwn, 1>;
using Mixed = Eigen::Matrix<double, kShared, kOwn>;
using Matrix = Eigen::MatrixXd;

/// The sizes are known at run time only. With sizes known at compile time, each would get a decomposition of its own, and
/// compiling those would take longer than the rest of this file.
Matrix solved(const Matrix& information, const Matrix& right_side) {
  return information.ldlt().solve(right_side);
}

double log_determinant_of(const Matrix& information) {
  return information.ldlt().vectorD().array().abs().log().sum();
}

// Inverse squares of the largest plausible values: lever arm 1 m, yaw one turn, skew 10 %, offset 10 s.
constexpr double kLeverPrior = 1, kYawPrior = 0.03, kSkewPrior = 100, kOffsetPrior = 0.01;

/// Information of one run in its blocks, without the fixed unknowns and with the weak priors.
struct Parts {
  SharedInformation shared;
  Mixed mixed;
  Own own;
  SharedVector shared_gradient;
  OwnVector own_gradient;
};

Parts parts_of(const InnovationSums& sums, const FixedParameters& fixed, double damping) {
  Information a = sums.information;
  Unknowns g = sums.gradient;
  a.diagonal() *= 1 + damping;
  a(kClockOffset, kClockOffset) += kOffsetPrior;
  const auto hold = [&](int unknown) {
    a.row(unknown).setZero();
    a.col(unknown).setZero();
    a(unknown, unknown) = unknown < kShared ? 0 : 1;
    g[unknown] = 0;
  };
  if (fixed.factors)
    for (const int unknown : {kCRight, kCLeft, kB}) hold(unknown);
  if (fixed.clock) {
    hold(kSkew);
    hold(kClockOffset);
  }
  if (fixed.lever_yaw) hold(kLeverYaw);
  return {a.topLeftCorner<kShared, kShared>(), a.block<kShared, kOwn>(0, kShared),
          a.block<kOwn, kOwn>(kShared, kShared), g.head<kShared>(), g.segment<kOwn>(kShared)};
}

SharedInformation with_priors(SharedInformation information, const FixedParameters& fixed) {
  if (fixed.factors) information.diagonal().head<3>().setOnes();
  information(kLeverX, kLeverX) += kLeverPrior;
  information(kLeverY, kLeverY) += kLeverPrior;
  information(kLeverYaw, kLeverYaw) += fixed.lever_yaw ? 1 : kYawPrior;
  information(kSkew, kSkew) += fixed.clock ? 1 : kSkewPrior;
  return information;
}

Reduced reduced(const Parts& parts) {
  const Mixed weighted = solved(parts.own, parts.mixed.transpose()).transpose();
  return {parts.shared - weighted * parts.mixed.transpose(),
          parts.shared_gradient - weighted * parts.own_gradient};
}

}  // namespace

Reduced reduced(const InnovationSums& sums, const FixedParameters& fixed, double damping) {
  return reduced(parts_of(sums, fixed, damping));
}

std::vector<Unknowns> gauss_newton_step(std::span<const InnovationSums> sums, const FixedParameters& fixed,
                                        double damping) {
  SharedInformation information = SharedInformation::Zero();
  SharedVector gradient = SharedVector::Zero();
  std::vector<Parts> parts;
  for (const InnovationSums& run : sums) {
    parts.push_back(parts_of(run, fixed, damping));
    const Reduced r = reduced(parts.back());
    information += r.information;
    gradient += r.gradient;
  }
  const SharedVector shared = solved(with_priors(information, fixed), gradient);
  std::vector<Unknowns> steps;
  for (const Parts& run : parts) {
    Unknowns step = Unknowns::Zero();
    step.head<kShared>() = shared;
    step.segment<kOwn>(kShared) = solved(run.own, run.own_gradient - run.mixed.transpose() * shared);
    steps.push_back(step);
  }
  return steps;
}

SharedInformation shared_covariance(const SharedInformation& information, const FixedParameters& fixed) {
  return solved(with_priors(information, fixed), SharedInformation::Identity());
}

double log_determinant(std::span<const InnovationSums> sums, const FixedParameters& fixed) {
  SharedInformation information = SharedInformation::Zero();
  double sum = 0;
  for (const InnovationSums& run : sums) {
    const Parts parts = parts_of(run, fixed, 0);
    sum += log_determinant_of(parts.own);
    information += reduced(parts).information;
  }
  return sum + log_determinant_of(with_priors(information, fixed));
}

OneUnknown arc_wheelbase(std::span<const InnovationSums> sums, const FixedParameters& fixed) {
  SharedInformation information = SharedInformation::Zero();
  SharedVector mixed = SharedVector::Zero(), gradient = SharedVector::Zero();
  double own_information = 0, own_gradient = 0;
  for (const InnovationSums& run : sums) {
    const Parts parts = parts_of(run, fixed, 0);
    const Reduced r = reduced(parts);
    SharedVector with_shared = run.information.col(kArcWheelbase).head<kShared>();
    OwnVector with_own = run.information.col(kArcWheelbase).segment<kOwn>(kShared);
    if (fixed.clock) with_shared[kSkew] = with_own[kOwn - 1] = 0;
    if (fixed.lever_yaw) with_shared[kLeverYaw] = 0;
    information += r.information;
    gradient += r.gradient;
    const OwnVector weighted = solved(parts.own, with_own);
    mixed += with_shared - parts.mixed * weighted;
    own_information += run.information(kArcWheelbase, kArcWheelbase) - with_own.dot(weighted);
    own_gradient += run.gradient[kArcWheelbase] - weighted.dot(parts.own_gradient);
  }
  const SharedInformation covariance = shared_covariance(information, fixed);
  const double left = own_information - mixed.dot(covariance * mixed);
  if (!(left > 0)) return {0, std::numeric_limits<double>::infinity()};
  return {(own_gradient - mixed.dot(covariance * gradient)) / left, 1 / std::sqrt(left)};
}

double clock_offset_variance(const InnovationSums& sums, const SharedInformation& covariance,
                             const FixedParameters& fixed) {
  const Parts parts = parts_of(sums, fixed, 0);
  // The clock offset's row of the inverse for this run alone, and what the uncertainty of the shared unknowns adds.
  const OwnVector own = solved(parts.own, OwnVector::Unit(kOwn - 1));
  const SharedVector by_shared = parts.mixed * own;
  return own[kOwn - 1] + by_shared.dot(covariance * by_shared);
}

}  // namespace astro::calibration
