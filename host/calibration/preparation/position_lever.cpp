#include "host/calibration/preparation/position_lever.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <complex>

#include "host/calibration/preparation/path_alignment.hpp"

namespace astro::calibration {
namespace {

using Complex = std::complex<double>;

// Enough rotation to separate the lever arm from the path, and too little for wrong factors to bend the path.
constexpr double kPiece_rad = 4;
// Squares of the parts of wheelbase and lever arm that a piece must still determine once the other unknowns are
// eliminated. With less, the piece lacks lines or turns.
constexpr double kLeastTold = 1e-3;
// Plausible range of the scale |r|, the length of truth over that of the dead-reckoned path, ideally 1.
constexpr double kLeastScale = 0.5, kMostScale = 2;

/// Least squares of one piece.
class Piece {
 public:
  void add(const BodySample& robot, const BodySample& body) {
    if (count_ == 0) origin_ = {robot.x_m, robot.y_m};
    const Complex way = Complex(robot.x_m, robot.y_m) - origin_;
    const Eigen::Vector3cd row(1, way, std::polar(1.0, robot.theta_rad));
    normal_ += row.conjugate() * row.transpose();
    right_side_ += row.conjugate() * Complex(body.x_m, body.y_m);
    turned_rad_ += count_ > 0 ? std::abs(robot.theta_rad - last_rad_) : 0;
    last_rad_ = robot.theta_rad;
    ++count_;
  }

  double turned_rad() const { return turned_rad_; }

  /// Adds the lever arm by this piece with its weight.
  void finish(double wheelbase_m, Complex& lever_m, double& weight) const {
    const Eigen::FullPivLU<Eigen::Matrix3cd> lu(normal_);
    if (!lu.isInvertible()) return;
    const Eigen::Matrix3cd inverse = lu.inverse();
    // Information about path and lever arm after elimination of the others, relative to that before.
    const double way = 1 / inverse(1, 1).real(), lever = 1 / inverse(2, 2).real();
    if (!(way > kLeastTold * wheelbase_m * wheelbase_m * count_) || !(lever > kLeastTold * count_)) return;
    const Eigen::Vector3cd found = inverse * right_side_;
    if (!(std::abs(found[1]) > kLeastScale && std::abs(found[1]) < kMostScale)) return;
    lever_m += lever * found[2] * std::conj(found[1]) / std::norm(found[1]);
    weight += lever;
  }

 private:
  Complex origin_;
  Eigen::Matrix3cd normal_ = Eigen::Matrix3cd::Zero();
  Eigen::Vector3cd right_side_ = Eigen::Vector3cd::Zero();
  double turned_rad_ = 0, last_rad_ = 0;
  int count_ = 0;
};

}  // namespace

std::optional<LeverArm> lever_of_positions(const PreparedRuns& runs, const WheelFactors& factors) {
  Complex lever_m = 0;
  double weight = 0;
  for (std::size_t i = 0; i < runs.runs.size(); ++i) {
    const PreparedRun& run = runs.runs[i];
    const std::vector<BodySample> robot = dead_reckoned(run, runs.clocks[i], factors);
    Piece piece;
    for (std::size_t k = 0; k < robot.size(); ++k) {
      piece.add(robot[k], run.truth[k]);
      if (piece.turned_rad() < kPiece_rad && k + 1 < robot.size()) continue;
      piece.finish(factors.b_m, lever_m, weight);
      piece = {};
    }
  }
  if (!(weight > 0)) return {};
  lever_m /= weight;
  return LeverArm{lever_m.real(), lever_m.imag(), 0};
}

}  // namespace astro::calibration
