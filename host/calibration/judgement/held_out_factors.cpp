#include "host/calibration/judgement/held_out_factors.hpp"

#include <Eigen/Dense>
#include <algorithm>

namespace astro::calibration {
namespace {

// If held-out runs have more than this share of the information, the factors of the others are twice as uncertain as what the
// held-out runs show, and more noise would be judged than factors.
constexpr double kMostShare = 0.8;

}  // namespace

HeldOutFactors held_out_factors(const Pool& all, const Pool& others, const FactorVector& change) {
  const FactorMatrix of_others = others.information();
  const Eigen::LLT<FactorMatrix> whole(all.information());
  const auto lower = whole.matrixL();
  const FactorMatrix left = lower.solve(FactorMatrix(all.information() - of_others));
  const Eigen::SelfAdjointEigenSolver<FactorMatrix> shares(lower.solve(FactorMatrix(left.transpose())));
  const FactorMatrix& directions = shares.eigenvectors();
  const FactorVector found = directions.transpose() * (whole.matrixU() * change);
  const FactorVector gradient =
      directions.transpose() * lower.solve(FactorVector(of_others * others.factor_step()));
  HeldOutFactors out;
  FactorVector by_others = FactorVector::Zero();
  for (int i = 0; i < kFactors; ++i) {
    const double share = std::clamp(shares.eigenvalues()[i], 0.0, 1.0);
    const double gain = share * found[i] * found[i];
    if (share > kMostShare) {
      ++out.undetermined;
      out.not_judged += gain;
    } else {
      by_others[i] = found[i] + gradient[i] / (1 - share);
      out.judged += gain;
    }
  }
  out.change = whole.matrixU().solve(FactorVector(directions * by_others));
  return out;
}

}  // namespace astro::calibration
