#include "host/calibration/likelihood/normal_equations.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

namespace astro::calibration {
namespace {

// Whatever is eliminated has four unknowns: a run's own, those of its session, the factors. So one size of decomposition does.
static_assert(kOwn == kFactors && kOfSession == kFactors);
using Block = FactorMatrix;
using BlockVector = FactorVector;
using Mixed = Eigen::Matrix<double, kShared, kOwn>;

struct Solved {
  Block inverse;
  double log_determinant;
};

Solved solved(const Block& information) {
  const Eigen::LDLT<Block> ldlt(information);
  return {ldlt.solve(Block::Identity()), ldlt.vectorD().array().abs().log().sum()};
}

// Inverse squares of the largest plausible values: e 0.1, lever arm 1 m, yaw one turn, skew 10 %, offset 10 s.
constexpr double kEPrior = 100, kLeverPrior = 1, kYawPrior = 0.03, kSkewPrior = 100, kOffsetPrior = 0.01;

/// Information of one run in its blocks, without the fixed unknowns and with the weak priors.
struct Parts {
  SharedInformation shared;
  Mixed mixed;
  Block own;
  SharedVector shared_gradient;
  BlockVector own_gradient;
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

Reduced reduced(const Parts& parts, int session) {
  const Mixed weighted = parts.mixed * solved(parts.own).inverse;
  return {parts.shared - weighted * parts.mixed.transpose(),
          parts.shared_gradient - weighted * parts.own_gradient, session};
}

}  // namespace

Reduced reduced(const InnovationSums& sums, const FixedParameters& fixed, double damping) {
  return reduced(parts_of(sums, fixed, damping), sums.session);
}

std::vector<Reduced> reduced(const InnovationSums& run, std::span<const InnovationSums> stretches,
                             const FixedParameters& fixed) {
  const Parts whole = parts_of(run, fixed, 0);
  const Mixed weighted = whole.mixed * solved(whole.own).inverse;
  std::vector<Reduced> out;
  for (const InnovationSums& stretch : stretches) {
    const Parts part = parts_of(stretch, fixed, 0);
    const SharedInformation crossed = weighted * part.mixed.transpose();
    out.push_back({part.shared - crossed - crossed.transpose() + weighted * part.own * weighted.transpose(),
                   part.shared_gradient - weighted * part.own_gradient, run.session});
  }
  return out;
}

void Pool::add(const Reduced& run, double sign) {
  while (static_cast<int>(sessions_.size()) <= run.session)
    sessions_.push_back(
        {SharedInformation::Zero(), SharedVector::Zero(), static_cast<int>(sessions_.size())});
  Reduced& session = sessions_[static_cast<std::size_t>(run.session)];
  session.information += sign * run.information;
  session.gradient += sign * run.gradient;
}

Pool::Settled Pool::settled(const Reduced& session) const {
  Block own = session.information.bottomRightCorner<kOfSession, kOfSession>();
  const auto add_prior = [&](int unknown, double prior) {
    own(unknown - kFactors, unknown - kFactors) += prior;
  };
  add_prior(kLeverX, kLeverPrior);
  add_prior(kLeverY, kLeverPrior);
  add_prior(kLeverYaw, fixed_.lever_yaw ? 1 : kYawPrior);
  add_prior(kSkew, fixed_.clock ? 1 : kSkewPrior);
  const Solved by_own = solved(own);
  const Block mixed = session.information.topRightCorner<kFactors, kOfSession>();
  Settled out;
  out.own_covariance = by_own.inverse;
  out.log_determinant = by_own.log_determinant;
  out.weighted = mixed * by_own.inverse;
  out.information =
      session.information.topLeftCorner<kFactors, kFactors>() - out.weighted * mixed.transpose();
  out.own_gradient = session.gradient.tail<kOfSession>();
  out.gradient = session.gradient.head<kFactors>() - out.weighted * out.own_gradient;
  return out;
}

FactorMatrix Pool::information() const {
  Block sum = Block::Zero();
  for (const Reduced& session : sessions_) sum += settled(session).information;
  if (fixed_.factors) sum.diagonal().setOnes();
  sum(kE, kE) += fixed_.e ? 1 : kEPrior;
  return sum;
}

FactorMatrix Pool::factor_covariance() const {
  FactorMatrix covariance = solved(information()).inverse;
  if (fixed_.e) covariance(kE, kE) = 0;
  return covariance;
}

FactorVector Pool::factor_step() const {
  BlockVector gradient = BlockVector::Zero();
  for (const Reduced& session : sessions_) gradient += settled(session).gradient;
  if (!fixed_.e && !fixed_.factors) gradient[kE] -= kEPrior * e_;
  return solved(information()).inverse * gradient;
}

SharedInformation Pool::covariance(int session) const {
  const Settled of_session = settled(sessions_.at(static_cast<std::size_t>(session)));
  const FactorMatrix factors = factor_covariance();
  SharedInformation out;
  out.topLeftCorner<kFactors, kFactors>() = factors;
  out.topRightCorner<kFactors, kOfSession>() = -factors * of_session.weighted;
  out.bottomLeftCorner<kOfSession, kFactors>() = out.topRightCorner<kFactors, kOfSession>().transpose();
  out.bottomRightCorner<kOfSession, kOfSession>() =
      of_session.own_covariance + of_session.weighted.transpose() * factors * of_session.weighted;
  return out;
}

SharedVector Pool::step(int session) const {
  const Settled of_session = settled(sessions_.at(static_cast<std::size_t>(session)));
  SharedVector out;
  out.head<kFactors>() = factor_step();
  out.tail<kOfSession>() = of_session.own_covariance * of_session.own_gradient -
                           of_session.weighted.transpose() * out.head<kFactors>();
  return out;
}

double Pool::log_determinant() const {
  double sum = solved(information()).log_determinant;
  for (const Reduced& session : sessions_) sum += settled(session).log_determinant;
  return sum;
}

std::vector<Unknowns> gauss_newton_step(std::span<const InnovationSums> sums, const FixedParameters& fixed,
                                        double damping, double e) {
  std::vector<Parts> parts;
  Pool pool(fixed, e);
  for (const InnovationSums& run : sums) {
    parts.push_back(parts_of(run, fixed, damping));
    pool.add(reduced(parts.back(), run.session));
  }
  std::vector<Unknowns> steps;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const SharedVector shared = pool.step(sums[i].session);
    Unknowns step = Unknowns::Zero();
    step.head<kShared>() = shared;
    step.segment<kOwn>(kShared) =
        solved(parts[i].own).inverse * (parts[i].own_gradient - parts[i].mixed.transpose() * shared);
    steps.push_back(step);
  }
  return steps;
}

Pool pool_of(std::span<const InnovationSums> sums, const FixedParameters& fixed, double e) {
  Pool pool(fixed, e);
  for (const InnovationSums& run : sums) pool.add(reduced(run, fixed, 0));
  return pool;
}

double prior_cost(double e) { return kEPrior * e * e; }

double log_determinant(std::span<const InnovationSums> sums, const FixedParameters& fixed) {
  double sum = pool_of(sums, fixed).log_determinant();
  for (const InnovationSums& run : sums) sum += solved(parts_of(run, fixed, 0).own).log_determinant;
  return sum;
}

double clock_offset_variance(const InnovationSums& sums, const SharedInformation& covariance,
                             const FixedParameters& fixed) {
  const Parts parts = parts_of(sums, fixed, 0);
  const Block own = solved(parts.own).inverse;
  const Eigen::Matrix<double, kOwn, kShared> by_shared = own * parts.mixed.transpose();
  constexpr int kClock = kClockOffset - kShared;
  return own(kClock, kClock) + by_shared.row(kClock).dot(covariance * by_shared.row(kClock).transpose());
}

}  // namespace astro::calibration
