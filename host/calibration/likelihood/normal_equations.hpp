#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "host/base/elimination.hpp"
#include "host/calibration/likelihood/innovation.hpp"
#include "host/calibration/motion/spread_of_e.hpp"

/// The Gauss-Newton step of several runs that share some unknowns and have others of their own.
namespace astro::calibration {

using SharedInformation = Eigen::Matrix<double, kShared, kShared>;
using SharedVector = Eigen::Matrix<double, kShared, 1>;
using FactorMatrix = Eigen::Matrix<double, kFactors, kFactors>;
using FactorVector = Eigen::Matrix<double, kFactors, 1>;

/// Which unknowns are not estimated.
struct FixedParameters {
  bool factors = false;    // c_R, c_L, b, e
  bool e = true;           // e alone
  bool session = false;    // lever arms and skews
  bool clock = false;      // offsets and skew
  bool lever_yaw = false;  // no headings anywhere
};

/// What is known of e before any drive (spread_of_e.hpp), as one more measurement of it.
struct PriorOfE {
  static constexpr double kStandardDeviation = kSpreadOfE;

  double e = 0;  // where the search is
  /// The errors of the estimate are widened in the end (MlEstimate::widening), and what is known beforehand is not known less
  /// well for that. So it counts that many times before.
  double weight = 1;

  double information() const { return weight / (kStandardDeviation * kStandardDeviation); }
  double gradient() const { return -information() * e; }
  double cost() const { return information() * e * e; }  // part of -2 log likelihood
};

/// One run with its own unknowns eliminated (Schur complement): its information about the factors, and about the lever arm and
/// the skew of its session.
struct Reduced {
  SharedInformation information;
  SharedVector gradient;
  int session = 0;
};
Reduced reduced(const InnovationSums& sums, const FixedParameters& fixed, double damping);

/// The same for the stretches of a run (innovations_by_stretch). The run's own unknowns are eliminated as in the whole run, so
/// that the results add up to `reduced` of the run.
std::vector<Reduced> reduced(const InnovationSums& run, std::span<const InnovationSums> stretches,
                             const FixedParameters& fixed);

/// The information of several runs together. An unknown that they do not observe (the lever arm in lines, the skew in one short
/// run) keeps the wide variance of a weak prior, so that the others can be determined.
class Pool {
 public:
  explicit Pool(const FixedParameters& fixed, const PriorOfE& prior = {}) : fixed_(fixed), prior_(prior) {}

  void add(const Reduced& run) { add(run, 1); }
  /// Makes room for a session of which there may be no run.
  void know(int session);
  void take_out(const Reduced& run) { add(run, -1); }

  /// About the factors, after the unknowns of the sessions are eliminated; 1 for those that are fixed.
  FactorMatrix information() const;
  /// The covariance of the factors alone; rows and columns of a fixed e are zero.
  FactorMatrix factor_covariance() const;
  FactorVector factor_step() const;
  /// The covariance of the factors and the unknowns of one session.
  SharedInformation covariance(int session) const;
  SharedVector step(int session) const;
  double log_determinant() const;

 private:
  using Session = Elimination<kFactors, kOfSession>;

  void add(const Reduced& run, double sign);
  Session eliminated(const Reduced& session) const;  // with the priors of its unknowns

  FixedParameters fixed_;
  PriorOfE prior_;
  std::vector<Reduced> sessions_;  // sums over the runs of each
};

/// The steps of all unknowns, one entry per run. The part of the factors is equal in all runs, and that of a session in its
/// runs. `damping` is that of Levenberg and Marquardt.
std::vector<Unknowns> gauss_newton_step(std::span<const InnovationSums> sums, const FixedParameters& fixed,
                                        double damping, const PriorOfE& prior = {});

/// The pool of all runs, without damping.
Pool pool_of(std::span<const InnovationSums> sums, const FixedParameters& fixed, const PriorOfE& prior = {});

/// Logarithm of the determinant of the information about all unknowns together. Added to -2 log likelihood it gives that of the
/// restricted likelihood, which allows for the fitted unknowns when noise is estimated. Source  Patterson & Thompson 1971,
/// Biometrika 58(3).
double log_determinant(std::span<const InnovationSums> sums, const FixedParameters& fixed,
                       const PriorOfE& prior = {});

/// Variance of one run's clock offset, given the covariance of the unknowns that it shares with others.
double clock_offset_variance(const InnovationSums& sums, const SharedInformation& covariance,
                             const FixedParameters& fixed);

}  // namespace astro::calibration
