#include "host/calibration/likelihood/normal_equations.hpp"

#include <cmath>
#include <limits>

namespace astro::calibration {
namespace {

using Run = Elimination<kShared, kOwn>;

// Inverse squares of the largest plausible values: lever arm 1 m, yaw one turn, skew 10 %, offset 10 s.
constexpr double kLeverPrior = 1, kYawPrior = 0.03, kSkewPrior = 100, kOffsetPrior = 0.01;

/// Information of one run in its blocks, without the fixed unknowns and with the weak priors.
struct Parts {
  SharedInformation shared;
  Run::Mixed mixed;
  Eigen::Matrix<double, kOwn, kOwn> own;
  SharedVector shared_gradient;
  Run::OwnVector own_gradient;

  Run run() const { return {own, mixed, own_gradient}; }
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
  if (fixed.factors || fixed.e) hold(kE);
  if (fixed.session)
    for (const int unknown : {kLeverX, kLeverY, kLeverYaw, kSkew}) hold(unknown);
  if (fixed.clock) {
    hold(kSkew);
    hold(kClockOffset);
  }
  if (fixed.lever_yaw) hold(kLeverYaw);
  return {a.topLeftCorner<kShared, kShared>(), a.block<kShared, kOwn>(0, kShared),
          a.block<kOwn, kOwn>(kShared, kShared), g.head<kShared>(), g.segment<kOwn>(kShared)};
}

Reduced reduced(const Parts& parts, const Run& run, int session) {
  return {parts.shared - run.lost_information(), parts.shared_gradient - run.lost_gradient(), session};
}

}  // namespace

Reduced reduced(const InnovationSums& sums, const FixedParameters& fixed, double damping) {
  const Parts parts = parts_of(sums, fixed, damping);
  return reduced(parts, parts.run(), sums.session);
}

std::vector<Reduced> reduced(const InnovationSums& run, std::span<const InnovationSums> stretches,
                             const FixedParameters& fixed) {
  const Run::Mixed weighted = parts_of(run, fixed, 0).run().weighted();
  std::vector<Reduced> out;
  for (const InnovationSums& stretch : stretches) {
    const Parts part = parts_of(stretch, fixed, 0);
    const SharedInformation crossed = weighted * part.mixed.transpose();
    out.push_back({part.shared - crossed - crossed.transpose() + weighted * part.own * weighted.transpose(),
                   part.shared_gradient - weighted * part.own_gradient, run.session});
  }
  return out;
}

void Pool::know(int session) {
  while (static_cast<int>(sessions_.size()) <= session)
    sessions_.push_back(
        {SharedInformation::Zero(), SharedVector::Zero(), static_cast<int>(sessions_.size())});
}

void Pool::add(const Reduced& run, double sign) {
  know(run.session);
  Reduced& session = sessions_[static_cast<std::size_t>(run.session)];
  session.information += sign * run.information;
  session.gradient += sign * run.gradient;
}

Pool::Session Pool::eliminated(const Reduced& session) const {
  SharedInformation information = session.information;
  const auto add_prior = [&](int unknown, double prior) { information(unknown, unknown) += prior; };
  add_prior(kLeverX, kLeverPrior);
  add_prior(kLeverY, kLeverPrior);
  add_prior(kLeverYaw, fixed_.lever_yaw ? 1 : kYawPrior);
  add_prior(kSkew, fixed_.clock ? 1 : kSkewPrior);
  return {information.bottomRightCorner<kOfSession, kOfSession>(),
          information.topRightCorner<kFactors, kOfSession>(), session.gradient.tail<kOfSession>()};
}

FactorMatrix Pool::information() const {
  FactorMatrix sum = FactorMatrix::Zero();
  for (const Reduced& session : sessions_)
    sum += session.information.topLeftCorner<kFactors, kFactors>() - eliminated(session).lost_information();
  if (fixed_.factors) sum.diagonal().setOnes();
  sum(kE, kE) += fixed_.e ? 1 : prior_.information();
  return sum;
}

FactorMatrix Pool::factor_covariance() const {
  FactorMatrix covariance = Inverted<kFactors>(information()).inverse;
  if (fixed_.e) covariance(kE, kE) = 0;
  return covariance;
}

FactorVector Pool::factor_step() const {
  FactorVector gradient = FactorVector::Zero();
  for (const Reduced& session : sessions_)
    gradient += session.gradient.head<kFactors>() - eliminated(session).lost_gradient();
  if (!fixed_.e && !fixed_.factors) gradient[kE] += prior_.gradient();
  return Inverted<kFactors>(information()).inverse * gradient;
}

SharedInformation Pool::covariance(int session) const {
  const Session of_session = eliminated(sessions_.at(static_cast<std::size_t>(session)));
  const Session::Mixed& weighted = of_session.weighted();
  const FactorMatrix factors = factor_covariance();
  SharedInformation out;
  out.topLeftCorner<kFactors, kFactors>() = factors;
  out.topRightCorner<kFactors, kOfSession>() = -factors * weighted;
  out.bottomLeftCorner<kOfSession, kFactors>() = out.topRightCorner<kFactors, kOfSession>().transpose();
  out.bottomRightCorner<kOfSession, kOfSession>() =
      of_session.own().inverse + weighted.transpose() * factors * weighted;
  return out;
}

SharedVector Pool::step(int session) const {
  SharedVector out;
  out.head<kFactors>() = factor_step();
  out.tail<kOfSession>() =
      eliminated(sessions_.at(static_cast<std::size_t>(session))).step(out.head<kFactors>());
  return out;
}

double Pool::log_determinant() const {
  double sum = Inverted<kFactors>(information()).log_determinant;
  for (const Reduced& session : sessions_) sum += eliminated(session).own().log_determinant;
  return sum;
}

std::vector<Unknowns> gauss_newton_step(std::span<const InnovationSums> sums, const FixedParameters& fixed,
                                        double damping, const PriorOfE& prior) {
  std::vector<Run> runs;
  Pool pool(fixed, prior);
  for (const InnovationSums& one : sums) {
    const Parts parts = parts_of(one, fixed, damping);
    runs.push_back(parts.run());
    pool.add(reduced(parts, runs.back(), one.session));
  }
  std::vector<Unknowns> steps;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    Unknowns step = Unknowns::Zero();
    step.head<kShared>() = pool.step(sums[i].session);
    step.segment<kOwn>(kShared) = runs[i].step(step.head<kShared>());
    steps.push_back(step);
  }
  return steps;
}

Pool pool_of(std::span<const InnovationSums> sums, const FixedParameters& fixed, const PriorOfE& prior) {
  Pool pool(fixed, prior);
  for (const InnovationSums& run : sums) pool.add(reduced(run, fixed, 0));
  return pool;
}

double log_determinant(std::span<const InnovationSums> sums, const FixedParameters& fixed,
                       const PriorOfE& prior) {
  double sum = pool_of(sums, fixed, prior).log_determinant();
  for (const InnovationSums& run : sums) sum += parts_of(run, fixed, 0).run().own().log_determinant;
  return sum;
}

double clock_offset_variance(const InnovationSums& sums, const SharedInformation& covariance,
                             const FixedParameters& fixed) {
  const Run run = parts_of(sums, fixed, 0).run();
  constexpr int kClock = kClockOffset - kShared;
  const SharedVector by_shared = run.weighted().col(kClock);
  return run.own().inverse(kClock, kClock) + by_shared.dot(covariance * by_shared);
}

}  // namespace astro::calibration
