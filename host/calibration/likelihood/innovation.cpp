#include "host/calibration/likelihood/innovation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "host/calibration/likelihood/filter_steps.hpp"
#include "host/calibration/likelihood/huber.hpp"

namespace astro::calibration {
namespace {

using namespace filter;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Sensitivity = Eigen::Matrix<double, 3, kUnknowns>;

class Filter {
 public:
  Filter(const PreparedRun& run, const Unknowns& unknowns, const NoiseModel& noise, Doubt doubt,
         bool look_at_truth)
      : u_(unknowns),
        noise_(noise),
        doubt_(doubt),
        headings_(run.has_headings),
        looks_(look_at_truth),
        state_(unknowns.segment<3>(kStartX)) {
    by_.setZero();
    by_.block<3, 3>(0, kStartX).setIdentity();
  }

  void move(const Moment& from, const WheelState& at, const Moment& to, const WheelState& then,
            Motion motion) {
    const double left_m = then.left_m - at.left_m, right_m = then.right_m - at.right_m;
    if (left_m == 0 && right_m == 0) return;
    const Arc arc = arc_of(state_[2], u_[kCLeft] * left_m, u_[kCRight] * right_m, u_[kB]);
    state_ += Vector3d(arc.dx_m, arc.dy_m, arc.turn_rad);
    const Matrix3d f = transition(arc);
    covariance_ = f * covariance_ * f.transpose() + noise_.K_m * slip_per_K(arc, left_m, right_m);

    by_.row(0) += f(0, 2) * by_.row(2);
    by_.row(1) += f(1, 2) * by_.row(2);
    by_.col(kCLeft) += left_m * arc.by_left;
    by_.col(kCRight) += right_m * arc.by_right;
    const Vector3d by_turn = arc.turn_rad * arc.by_turn;
    by_.col(kB) -= by_turn / u_[kB];
    if (motion == Motion::arc) by_.col(kArcWheelbase) -= by_turn;
    const Vector3d by_end =
        u_[kCLeft] * then.left_mps * arc.by_left + u_[kCRight] * then.right_mps * arc.by_right;
    const Vector3d by_begin =
        u_[kCLeft] * at.left_mps * arc.by_left + u_[kCRight] * at.right_mps * arc.by_right;
    by_.col(kClockOffset) += by_end - by_begin;
    by_.col(kSkew) += to.by_skew_s * by_end - from.by_skew_s * by_begin;
  }

  void look(const BodySample& sample, Motion motion) {
    if (headings_) {
      look_at<3>(sample, motion);
    } else {
      look_at<2>(sample, motion);
    }
  }

  InnovationSums sums;
  std::vector<Vector3d>* standardised = nullptr;  // where each innovation is kept, if anywhere

 private:
  template <int N>
  void look_at(const BodySample& sample, Motion motion) {
    const Expected expected = expected_body(state_, u_);
    const Eigen::Matrix<double, N, 3> h = expected.by_state.topRows<N>();
    Eigen::Matrix<double, N, kUnknowns> j = h * by_;
    j.template block<N, 3>(0, kLeverX) += expected.by_lever.topRows<N>();

    Eigen::Matrix<double, N, 1> r = Eigen::Matrix<double, N, 1>::Zero();
    if (looks_) {
      r[0] = sample.x_m - expected.body[0];
      r[1] = sample.y_m - expected.body[1];
      if constexpr (N == 3) r[2] = std::remainder(sample.theta_rad - expected.body[2], 2 * std::numbers::pi);
    }
    Eigen::Matrix<double, N, N> tracker = Eigen::Matrix<double, N, N>::Zero();
    tracker.diagonal().template head<2>().array() += noise_.sigma_xy_m * noise_.sigma_xy_m;
    if constexpr (N == 3) tracker(2, 2) += noise_.sigma_theta_rad * noise_.sigma_theta_rad;

    Eigen::Matrix<double, 3, N> ph = covariance_ * h.transpose();
    Eigen::Matrix<double, N, N> s = h * ph + tracker;
    Eigen::Matrix<double, N, N> weight = s.inverse();
    double squared = r.dot(weight * r);
    sums.cost += std::log(s.determinant());
    constexpr double kLimit = N == 3 ? kHuber3 : kHuber2;
    if (doubt_ != Doubt::nobody && squared > kLimit) {
      const Eigen::Matrix<double, N, N> slip = s - tracker;
      const HuberLoss loss = huber_loss<N>(r, slip, tracker.diagonal(), kLimit, doubt_);
      sums.cost += loss.cost;
      covariance_ *= loss.slip;
      ph *= loss.slip;
      s = loss.slip * slip + loss.tracker * tracker;
      weight = s.inverse();
      squared = r.dot(weight * r);
    } else {
      sums.cost += squared;
    }
    count(r, squared, motion, N);
    if (standardised != nullptr) standardise<N>(r, s);

    const Eigen::Matrix<double, kUnknowns, N> jw = j.transpose() * weight;
    sums.information.noalias() += jw * j;
    sums.gradient.noalias() += jw * r;

    const Eigen::Matrix<double, 3, N> gain = ph * weight;
    state_ += gain * r;
    by_.noalias() -= gain * j;
    covariance_ -= gain * ph.transpose();
    covariance_ = (covariance_ + covariance_.transpose().eval()) / 2;
  }

  template <int N>
  void standardise(const Eigen::Matrix<double, N, 1>& r, const Eigen::Matrix<double, N, N>& s) {
    Eigen::Matrix<double, N, N> to_robot = Eigen::Matrix<double, N, N>::Identity();
    const double cosine = std::cos(state_[2]), sine = std::sin(state_[2]);
    to_robot.template topLeftCorner<2, 2>() << cosine, sine, -sine, cosine;
    const Eigen::Matrix<double, N, N> turned = to_robot * s * to_robot.transpose();
    Vector3d standard = Vector3d::Zero();
    standard.head<N>() = turned.llt().matrixL().solve(to_robot * r);
    standardised->push_back(standard);
  }

  template <class Innovation>
  void count(const Innovation& r, double squared, Motion motion, int freedom) {
    sums.chi_square += squared;
    sums.degrees_of_freedom += freedom;
    MotionTotals& totals = sums.motion[static_cast<std::size_t>(motion)];
    ++totals.samples;
    totals.sum_xy_m2 += r[0] * r[0] + r[1] * r[1];
    if (freedom == 3) totals.sum_theta_rad2 += r[freedom - 1] * r[freedom - 1];
    totals.chi_square += squared;
  }

  const Unknowns& u_;
  const NoiseModel& noise_;
  const Doubt doubt_;
  const bool headings_, looks_;
  Vector3d state_;
  Matrix3d covariance_ = Matrix3d::Zero();
  Sensitivity by_;
};

}  // namespace

InnovationSums mean_of(std::span<const InnovationSums> passes) {
  InnovationSums mean;
  const auto count = static_cast<double>(passes.size());
  double freedom = 0;
  std::array<double, 4> samples{};
  for (const InnovationSums& pass : passes) {
    mean.information += pass.information / count;
    mean.gradient += pass.gradient / count;
    mean.cost += pass.cost / count;
    mean.chi_square += pass.chi_square / count;
    freedom += pass.degrees_of_freedom / count;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      samples[i] += pass.motion[i].samples / count;
      mean.motion[i].sum_xy_m2 += pass.motion[i].sum_xy_m2 / count;
      mean.motion[i].sum_theta_rad2 += pass.motion[i].sum_theta_rad2 / count;
      mean.motion[i].chi_square += pass.motion[i].chi_square / count;
    }
  }
  mean.degrees_of_freedom = static_cast<int>(std::lround(freedom));
  for (std::size_t i = 0; i < samples.size(); ++i)
    mean.motion[i].samples = static_cast<int>(std::lround(samples[i]));
  return mean;
}

InnovationSums innovations(const PreparedRun& run, const Unknowns& unknowns, const NoiseModel& noise,
                           const Looks& looks) {
  Filter filter(run, unknowns, noise, looks.doubt, true);
  follow(run, unknowns, looks, filter);
  return filter.sums;
}

std::vector<Vector3d> standard_innovations(const PreparedRun& run, const Unknowns& unknowns,
                                           const NoiseModel& noise, const Looks& looks) {
  Filter filter(run, unknowns, noise, looks.doubt, true);
  std::vector<Vector3d> all;
  filter.standardised = &all;
  follow(run, unknowns, looks, filter);
  return all;
}

Information expected_information(const PreparedRun& run, const Unknowns& unknowns, const NoiseModel& noise) {
  Filter filter(run, unknowns, noise, Doubt::nobody, false);
  follow(run, unknowns, {}, filter);
  return filter.sums.information;
}

}  // namespace astro::calibration
