#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

/// Least squares with groups of unknowns that meet only in others, which they share: the poses of the pictures in a film, the
/// clock of one run, the lever arm of one session. For each group the normal equations are
///
///   | shared   mixed | | shared step |   | shared gradient |
///   | mixed'   own   | | own step    | = | own gradient    |
///
/// Its own unknowns are eliminated (Schur complement), which leaves equations of the shared ones alone. These add up over the
/// groups, so the cost grows with the number of groups, not with its cube.
///
/// Source  Triggs, McLauchlan, Hartley, Fitzgibbon 1999, Bundle adjustment: a modern synthesis, section 6.1.
namespace astro {

/// The inverse of an information matrix, and the logarithm of its determinant.
template <int N>
struct Inverted {
  using Square = Eigen::Matrix<double, N, N>;

  explicit Inverted(const Square& information) {
    const Eigen::LDLT<Square> ldlt(information);
    inverse = ldlt.solve(Square::Identity());
    log_determinant = ldlt.vectorD().array().abs().log().sum();
  }

  Square inverse;
  double log_determinant;
};

/// One group, whose own unknowns are eliminated. Shared may be Eigen::Dynamic.
template <int Shared, int Own>
class Elimination {
 public:
  using Mixed = Eigen::Matrix<double, Shared, Own>;
  using OwnVector = Eigen::Matrix<double, Own, 1>;
  using SharedVector = Eigen::Matrix<double, Shared, 1>;
  using SharedMatrix = Eigen::Matrix<double, Shared, Shared>;

  Elimination(const typename Inverted<Own>::Square& own, const Mixed& mixed, const OwnVector& gradient)
      : own_(own), mixed_(mixed), gradient_(gradient), weighted_(mixed * own_.inverse) {}

  /// What the own unknowns take from the information about the shared ones, and from their gradient.
  SharedMatrix lost_information() const { return weighted_ * mixed_.transpose(); }
  SharedVector lost_gradient() const { return weighted_ * gradient_; }

  /// The step of the own unknowns, given that of the shared ones.
  template <class Step>
  OwnVector step(const Step& shared) const {
    return own_.inverse * (gradient_ - mixed_.transpose() * shared);
  }

  /// The covariance of the own unknowns if the shared ones were known.
  const Inverted<Own>& own() const { return own_; }
  /// The mixed information times that covariance. Its negative transpose says how the own unknowns follow the shared ones.
  const Mixed& weighted() const { return weighted_; }

 private:
  Inverted<Own> own_;
  Mixed mixed_;
  OwnVector gradient_;
  Mixed weighted_;
};

}  // namespace astro
