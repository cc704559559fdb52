#include "host/calibration/innovation.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace astro::calibration {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Sensitivity = Eigen::Matrix<double, 3, kUnknowns>;

// An arc of constant twist stands for no more than this.
constexpr double kLongestStep_s = 0.06;
// Squares of Huber's thresholds: 99 % of chi-square with 2 and 3 degrees of freedom.
constexpr double kHuber2 = 9.210, kHuber3 = 11.345;
// What is left of a normal variance when the samples beyond them are left out: F(k + 2) / F(k) of chi-square.
constexpr double kInside2 = 0.95349, kInside3 = 0.96470;

/// A moment on the robot's clock, and how it moves with the clock's unknowns.
struct Moment {
  double time_s = 0, by_skew_s = 0;
};

/// One arc: where it leads, and what its end does when something changes.
struct Arc {
  double dx_m = 0, dy_m = 0;
  Vector3d by_left = Vector3d::Zero(), by_right = Vector3d::Zero();  // per metre of the wheel
  Vector3d by_turn = Vector3d::Zero();
  double turn_rad = 0;
};

Arc arc_of(double theta_rad, double left_m, double right_m, double b_m) {
  Arc arc;
  arc.turn_rad = (right_m - left_m) / b_m;
  const double half = arc.turn_rad / 2, centre_m = (left_m + right_m) / 2;
  const double sine = std::sin(half);
  const bool small = std::abs(half) < 1e-4;
  const double chord = small ? 1 - half * half / 6 : sine / half;
  const double chord_slope = small ? -half / 6 : (std::cos(half) - chord) / (2 * half);  // by the turn
  const double c = std::cos(theta_rad + half), s = std::sin(theta_rad + half);
  arc.dx_m = centre_m * chord * c;
  arc.dy_m = centre_m * chord * s;
  arc.by_turn = {centre_m * chord_slope * c - arc.dy_m / 2, centre_m * chord_slope * s + arc.dx_m / 2, 1};
  const Vector3d by_centre(chord * c / 2, chord * s / 2, 0);
  arc.by_left = by_centre - arc.by_turn / b_m;
  arc.by_right = by_centre + arc.by_turn / b_m;
  return arc;
}

Matrix3d transition(const Arc& arc) {
  Matrix3d f = Matrix3d::Identity();
  f(0, 2) = -arc.dy_m;
  f(1, 2) = arc.dx_m;
  return f;
}

Matrix3d slip_per_K(const Arc& arc, double left_m, double right_m) {
  return std::abs(left_m) * arc.by_left * arc.by_left.transpose() +
         std::abs(right_m) * arc.by_right * arc.by_right.transpose();
}

/// Where the tracked body should be, and how that moves with the state and the lever arm.
struct Expected {
  Vector3d body;
  Matrix3d by_state = Matrix3d::Identity(), by_lever = Matrix3d::Identity();
};

Expected expected_body(const Vector3d& state, const Unknowns& u) {
  const double c = std::cos(state[2]), s = std::sin(state[2]);
  const double x = c * u[kLeverX] - s * u[kLeverY], y = s * u[kLeverX] + c * u[kLeverY];
  Expected expected;
  expected.body = {state[0] + x, state[1] + y, state[2] + u[kLeverYaw]};
  expected.by_state(0, 2) = -y;
  expected.by_state(1, 2) = x;
  expected.by_lever.topLeftCorner<2, 2>() << c, -s, s, c;
  return expected;
}

/// The moving parts of the filter, shared by its three uses. A user sees each arc, then each truth sample.
template <class Use>
void follow(const PreparedRun& run, const Unknowns& u, Use& use) {
  const WheelPath wheels(run.source->wheels);
  const auto moment = [&](double truth_time_s) {
    const double by_skew_s = truth_time_s - run.clock_middle_s;
    return Moment{truth_time_s + u[kClockOffset] + u[kSkew] * by_skew_s, by_skew_s};
  };
  Moment from = moment(run.truth.front().time_s);
  WheelState at = wheels.at(from.time_s);
  for (std::size_t i = 0; i < run.truth.size(); ++i) {
    const Moment to = moment(run.truth[i].time_s);
    const int steps =
        i == 0 ? 0 : std::max(1, static_cast<int>(std::ceil((to.time_s - from.time_s) / kLongestStep_s)));
    const Moment begin = from;
    for (int step = 1; step <= steps; ++step) {
      const double part = static_cast<double>(step) / steps;
      const Moment next{begin.time_s + part * (to.time_s - begin.time_s),
                        begin.by_skew_s + part * (to.by_skew_s - begin.by_skew_s)};
      const WheelState then = wheels.at(next.time_s);
      use.move(from, at, next, then, run.motion[i]);
      from = next;
      at = then;
    }
    use.look(run.truth[i], run.motion[i]);
  }
}

class Filter {
 public:
  Filter(const PreparedRun& run, const Unknowns& unknowns, const NoiseModel& noise, bool huber,
         bool look_at_truth)
      : u_(unknowns),
        noise_(noise),
        huber_(huber),
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
    Eigen::Matrix<double, N, 1> tracker;
    tracker.setConstant(noise_.sigma_xy_m * noise_.sigma_xy_m);
    if constexpr (N == 3) tracker[2] = noise_.sigma_theta_rad * noise_.sigma_theta_rad;

    const Eigen::Matrix<double, 3, N> ph = covariance_ * h.transpose();
    Eigen::Matrix<double, N, N> s = h * ph;
    s.diagonal() += tracker;
    Eigen::Matrix<double, N, N> weight = s.inverse();
    double squared = r.dot(weight * r);
    sums.cost += std::log(s.determinant());
    constexpr double kLimit = N == 3 ? kHuber3 : kHuber2;
    if (huber_ && squared > kLimit) {
      // A sample this far out is a bad one: trusted as little as brings it to the threshold.
      const double trust = std::sqrt(kLimit / squared);
      sums.cost += 2 * std::sqrt(kLimit * squared) - kLimit;
      s.diagonal() += tracker * (1 / trust - 1);
      weight = s.inverse();
      squared = r.dot(weight * r);
    } else {
      sums.cost += squared;
    }
    count(r, squared, motion, N);

    const Eigen::Matrix<double, kUnknowns, N> jw = j.transpose() * weight;
    sums.information.noalias() += jw * j;
    sums.gradient.noalias() += jw * r;

    const Eigen::Matrix<double, 3, N> gain = ph * weight;
    state_ += gain * r;
    by_.noalias() -= gain * j;
    covariance_ -= gain * ph.transpose();
    covariance_ = (covariance_ + covariance_.transpose().eval()) / 2;
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
  const bool huber_, headings_, looks_;
  Vector3d state_;
  Matrix3d covariance_ = Matrix3d::Zero();
  Sensitivity by_;
};

/// The filter without derivatives by parameters, but with those of its covariance by the noise.
class NoiseFilter {
 public:
  NoiseFilter(const PreparedRun& run, const Unknowns& unknowns, const NoiseModel& noise, bool huber)
      : u_(unknowns),
        noise_(noise),
        huber_(huber),
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

    const Eigen::Matrix<double, 3, N> ph = covariance_ * h.transpose();
    Square s = h * ph + by_xy + by_theta;
    Square weight = s.inverse();
    const double squared = r.dot(weight * r);
    constexpr double kLimit = N == 3 ? kHuber3 : kHuber2;
    const bool outside = huber_ && squared > kLimit;
    if (outside) {
      const double mistrust = std::sqrt(squared / kLimit);
      s += (mistrust - 1) * (by_xy + by_theta);
      by_xy *= mistrust;
      by_theta *= mistrust;
      weight = s.inverse();
    }
    const Square slopes[3] = {h * by_[0] * h.transpose(), h * by_[1] * h.transpose() + by_xy,
                              h * by_[2] * h.transpose() + by_theta};
    if (!outside) add(slopes, weight, r, !huber_ ? 1 : N == 3 ? kInside3 : kInside2);

    const Eigen::Matrix<double, 3, N> gain = ph * weight;
    const Matrix3d keep = Matrix3d::Identity() - gain * h;
    state_ += gain * r;
    covariance_ = keep * covariance_;
    covariance_ = (covariance_ + covariance_.transpose().eval()) / 2;
    for (Matrix3d& d : by_) d = keep * d * keep.transpose();
    by_[1] += gain * by_xy * gain.transpose();
    by_[2] += gain * by_theta * gain.transpose();
  }

  template <class Square, class Innovation>
  void add(const Square (&slopes)[3], const Square& weight, const Innovation& r, double inside) {
    const Innovation wr = weight * r;
    Square ws[3];
    for (int i = 0; i < 3; ++i) {
      ws[i] = weight * slopes[i];
      slope.gradient[i] += inside * ws[i].trace() - wr.dot(slopes[i] * wr);
    }
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) slope.curvature(i, k) += inside * (ws[i] * ws[k]).trace();
  }

  const Unknowns& u_;
  const NoiseModel& noise_;
  const bool huber_, headings_;
  Vector3d state_;
  Matrix3d covariance_ = Matrix3d::Zero();
  Matrix3d by_[3];  // of the covariance by log K, log sigma_xy^2, log sigma_theta^2
};

}  // namespace

InnovationSums innovations(const PreparedRun& run, const Unknowns& unknowns, const NoiseModel& noise,
                           bool huber) {
  Filter filter(run, unknowns, noise, huber, true);
  follow(run, unknowns, filter);
  return filter.sums;
}

Information expected_information(const PreparedRun& run, const Unknowns& unknowns, const NoiseModel& noise) {
  Filter filter(run, unknowns, noise, false, false);
  follow(run, unknowns, filter);
  return filter.sums.information;
}

NoiseSlope noise_slope(const PreparedRun& run, const Unknowns& unknowns, const NoiseModel& noise,
                       bool huber) {
  NoiseFilter filter(run, unknowns, noise, huber);
  follow(run, unknowns, filter);
  return filter.slope;
}

}  // namespace astro::calibration
