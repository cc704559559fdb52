#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "host/calibration/likelihood/filter_steps.hpp"
#include "host/calibration/likelihood/huber.hpp"
#include "host/calibration/likelihood/innovation.hpp"

namespace astro::calibration {
namespace {

using namespace filter;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kNoises = NoiseSlope::kNoises;

/// The filter without derivatives by parameters, but with those of its state and covariance by the noise.
/// Leaving out that the innovations themselves change with the gain would do no harm for the right model, and
/// find the wrong noise for every other one.
class NoiseFilter {
 public:
  NoiseFilter(const PreparedRun& run, const Unknowns& unknowns, const NoiseModel& noise, Doubt doubt)
      : u_(unknowns),
        noise_(noise),
        doubt_(doubt),
        headings_(run.has_headings),
        state_(unknowns.segment<3>(kStartX)) {
    for (Matrix3d& d : by_) d.setZero();
  }

  void move(const Moment&, const WheelState& at, const Moment&, const WheelState& then, Motion) {
    const double left_m = then.left_m - at.left_m, right_m = then.right_m - at.right_m;
    if (left_m == 0 && right_m == 0) return;
    const Arc arc = arc_of(state_[2], u_[kCLeft] * left_m, u_[kCRight] * right_m, u_[kB]);
    state_ += Vector3d(arc.dx_m, arc.dy_m, arc.turn_rad);
    const Matrix3d f = transition(arc);
    const Matrix3d slip = noise_.K_m * slip_per_K(arc, left_m, right_m);
    covariance_ = f * covariance_ * f.transpose() + slip;
    for (Matrix3d& d : by_) d = f * d * f.transpose();
    by_[0] += slip;
    state_by_.row(0) += f(0, 2) * state_by_.row(2);
    state_by_.row(1) += f(1, 2) * state_by_.row(2);
  }

  void look(const BodySample& sample, Motion) {
    if (headings_) {
      look_at<3>(sample);
    } else {
      look_at<2>(sample);
    }
  }

  NoiseSlope slope;

 private:
  template <int N>
  void look_at(const BodySample& sample) {
    using Square = Eigen::Matrix<double, N, N>;
    const Expected expected = expected_body(state_, u_);
    const Eigen::Matrix<double, N, 3> h = expected.by_state.topRows<N>();
    Eigen::Matrix<double, N, 1> r;
    r[0] = sample.x_m - expected.body[0];
    r[1] = sample.y_m - expected.body[1];
    if constexpr (N == 3) r[2] = std::remainder(sample.theta_rad - expected.body[2], 2 * std::numbers::pi);
    Square by_xy = Square::Zero(), by_theta = Square::Zero();
    by_xy(0, 0) = by_xy(1, 1) = noise_.sigma_xy_m * noise_.sigma_xy_m;
    if constexpr (N == 3) by_theta(2, 2) = noise_.sigma_theta_rad * noise_.sigma_theta_rad;

    Eigen::Matrix<double, 3, N> ph = covariance_ * h.transpose();
    Square s = h * ph + by_xy + by_theta;
    Square weight = s.inverse();
    const Square slopes[kNoises] = {h * by_[0] * h.transpose(), h * by_[1] * h.transpose() + by_xy,
                                    h * by_[2] * h.transpose() + by_theta};
    const Eigen::Matrix<double, N, kNoises> r_by = -h * state_by_;
    const double squared = r.dot(weight * r);
    constexpr double kLimit = N == 3 ? kHuber3 : kHuber2;
    const bool bounded = doubt_ != Doubt::nobody, outside = bounded && squared > kLimit;
    const double trust = outside ? std::sqrt(kLimit / squared) : 1;
    add(slopes, weight, r, r_by, trust * trust, !bounded ? 1 : N == 3 ? kKept3 : kKept2);
    if (outside) {
      // As the other filter does it, s and t held.
      const Square tracker = by_xy + by_theta;
      const Square slip = s - tracker;
      const HuberLoss loss = huber_loss<N>(r, slip, tracker.diagonal(), kLimit, doubt_);
      s = loss.slip * slip + loss.tracker * tracker;
      by_xy *= loss.tracker;
      by_theta *= loss.tracker;
      covariance_ *= loss.slip;
      ph *= loss.slip;
      for (Matrix3d& d : by_) d *= loss.slip;
      weight = s.inverse();
    }

    const Eigen::Matrix<double, 3, N> gain = ph * weight;
    const Matrix3d keep = Matrix3d::Identity() - gain * h;
    const Square tracker_by[kNoises] = {Square::Zero(), by_xy, by_theta};
    const Eigen::Matrix<double, N, 1> wr = weight * r;
    for (int i = 0; i < kNoises; ++i)
      state_by_.col(i) += (keep * by_[i] * h.transpose() - gain * tracker_by[i]) * wr + gain * r_by.col(i);
    state_ += gain * r;
    covariance_ = keep * covariance_;
    covariance_ = (covariance_ + covariance_.transpose().eval()) / 2;
    for (int i = 0; i < kNoises; ++i)
      by_[i] = keep * by_[i] * keep.transpose() + gain * tracker_by[i] * gain.transpose();
  }

  template <class Square, class Innovation, class Slopes>
  void add(const Square (&slopes)[kNoises], const Square& weight, const Innovation& r, const Slopes& r_by,
           double trust, double kept) {
    const Innovation wr = weight * r;
    Square ws[kNoises];
    for (int i = 0; i < kNoises; ++i) {
      ws[i] = weight * slopes[i];
      slope.gradient[i] += kept * ws[i].trace() + trust * (2 * wr.dot(r_by.col(i)) - wr.dot(slopes[i] * wr));
    }
    for (int i = 0; i < kNoises; ++i)
      for (int k = 0; k < kNoises; ++k) slope.curvature(i, k) += kept * (ws[i] * ws[k]).trace();
    slope.curvature += 2 * trust * r_by.transpose() * weight * r_by;
  }

  const Unknowns& u_;
  const NoiseModel& noise_;
  const Doubt doubt_;
  const bool headings_;
  Vector3d state_;
  Matrix3d covariance_ = Matrix3d::Zero();
  Eigen::Matrix<double, 3, kNoises> state_by_ = Eigen::Matrix<double, 3, kNoises>::Zero();
  Matrix3d by_[kNoises];  // of the covariance, in the order of NoiseSlope
};

}  // namespace

NoiseSlope noise_slope(const PreparedRun& run, const Unknowns& unknowns, const NoiseModel& noise,
                       const Looks& looks) {
  NoiseFilter filter(run, unknowns, noise, looks.doubt);
  follow(run, unknowns, looks, filter);
  return filter.slope;
}

}  // namespace astro::calibration
