#include "host/calibration/likelihood/kalman_filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace astro::calibration {
namespace {

double wrapped(double angle_rad) {
  if (std::abs(angle_rad) < std::numbers::pi) return angle_rad;
  // One turn more or less is exact in this range, and so equal to the remainder, which is slow.
  if (std::abs(angle_rad) < 3 * std::numbers::pi)
    return angle_rad - std::copysign(2 * std::numbers::pi, angle_rad);
  return std::remainder(angle_rad, 2 * std::numbers::pi);
}

/// Huber's loss is rare, so it may use decompositions.
HuberLoss loss_of(const Vector3& innovation, const Symmetric3& slip, const Symmetric3& tracker, double limit,
                  RobustMode robust) {
  Eigen::Matrix3d p;
  p << slip.xx, slip.xy, slip.xt, slip.xy, slip.yy, slip.yt, slip.xt, slip.yt, slip.tt;
  return huber_loss({innovation[0], innovation[1], innovation[2]}, p, {tracker.xx, tracker.yy, tracker.tt},
                    limit, robust);
}

/// A direction as cosine and sine. Turning it takes no sine of its own, of which a pass over a drive would take two for each
/// sample.
struct Direction {
  double cosine = 1, sine = 0;

  explicit Direction(double angle_rad) : cosine(std::cos(angle_rad)), sine(std::sin(angle_rad)) {}
  Direction(double c, double s) : cosine(c), sine(s) {}

  Direction turned(double c, double s) const { return {c * cosine - s * sine, s * cosine + c * sine}; }
  /// Turns by a correction, which is usually a few milliradians.
  Direction turned(double angle_rad) const {
    if (std::abs(angle_rad) > 0.01) return turned(std::cos(angle_rad), std::sin(angle_rad));
    const double q = angle_rad * angle_rad;  // the first terms left out are below 1e-17
    return turned(1 - q / 2 * (1 - q / 12 * (1 - q / 30)), angle_rad * (1 - q / 6 * (1 - q / 20)));
  }
  /// Restores the length 1 by one Newton step, because each turn rounds.
  Direction of_length_one() const {
    const double unit = 1.5 - 0.5 * (cosine * cosine + sine * sine);
    return {unit * cosine, unit * sine};
  }
};

class KalmanFilter {
 public:
  /// All references must outlive the filter.
  KalmanFilter(const Moves& moves, const NoiseModel& noise, RobustMode robust, TruthUse truth,
               std::span<Accumulator* const> accumulators)
      : u_(moves.unknowns()),
        noise_(noise),
        robust_(robust),
        truth_(truth),
        has_headings_(moves.run().has_headings),
        accumulators_(accumulators),
        x_m_(u_[kStartX]),
        y_m_(u_[kStartY]),
        theta_rad_(u_[kStartTheta]),
        heading_(theta_rad_) {}

  void predict(const Move& move) {
    const double c = heading_.cosine, s = heading_.sine;
    const Prediction step{move,
                          c,
                          s,
                          c * move.x_m - s * move.y_m,
                          s * move.x_m + c * move.y_m,
                          noise_.K_m * rotated(move.slip_per_K, c, s)};
    x_m_ += step.dx_m;
    y_m_ += step.dy_m;
    theta_rad_ += move.turn_rad;
    heading_ = heading_.turned(move.cosine, move.sine);
    covariance_ = sheared(covariance_, -step.dy_m, step.dx_m) + step.slip_covariance;
    for (Accumulator* each : accumulators_) each->predict(step);
  }

  /// The robot moved on an unknown way, and turned by an unknown angle.
  void lose_place(double variance_m2, double variance_rad2) {
    covariance_.xx += variance_m2;
    covariance_.yy += variance_m2;
    covariance_.tt += variance_rad2;
  }

  void update(const BodySample& sample, Motion motion) {
    Update step;
    step.has_heading = has_headings_;
    heading_ = heading_.of_length_one();
    step.cosine = heading_.cosine;
    step.sine = heading_.sine;
    step.lever_x_m = step.cosine * u_[kLeverX] - step.sine * u_[kLeverY];
    step.lever_y_m = step.sine * u_[kLeverX] + step.cosine * u_[kLeverY];
    step.innovation = innovation(sample, step);
    step.tracker_covariance = tracker_covariance();
    const Symmetric3 slip = step.seen(covariance_);
    step.expected_covariance = slip + step.tracker_covariance;
    step.expected_weight = inverse(step.expected_covariance);
    step.expected_chi_square = dot(step.innovation, product(step.expected_weight, step.innovation));
    down_weight(step, slip);
    const Matrix3 ph = step.with_state(covariance_);
    step.gain = product(ph, step.weight);
    for (Accumulator* each : accumulators_) each->update(step, motion);

    const Vector3 correction = product(step.gain, step.innovation);
    x_m_ += correction[0];
    y_m_ += correction[1];
    theta_rad_ += correction[2];
    heading_ = heading_.turned(correction[2]);
    covariance_ += -1 * symmetric_product(step.gain, ph);
  }

 private:
  Vector3 innovation(const BodySample& sample, const Update& step) const {
    if (truth_ == TruthUse::times) return {};
    return {sample.x_m - x_m_ - step.lever_x_m, sample.y_m - y_m_ - step.lever_y_m,
            has_headings_ ? wrapped(sample.theta_rad - theta_rad_ - u_[kLeverYaw]) : 0};
  }

  Symmetric3 tracker_covariance() const {
    constexpr double kOfTheConstant = 1;  // stands for the heading where there is none; see Update
    const double xy = noise_.sigma_xy_m * noise_.sigma_xy_m;
    const double theta = has_headings_ ? noise_.sigma_theta_rad * noise_.sigma_theta_rad : kOfTheConstant;
    return {xy, 0, 0, xy, 0, theta};
  }

  /// An outlier gets the covariance of wheels that slipped and a tracker that erred more than usual. `slip` is the part of
  /// the innovation's covariance that comes from the wheels.
  void down_weight(Update& step, const Symmetric3& slip) {
    step.is_outlier = robust_ != RobustMode::none && step.expected_chi_square > huber_limit(step);
    step.covariance = step.expected_covariance;
    step.weight = step.expected_weight;
    step.chi_square = step.expected_chi_square;
    step.loss.cost = step.chi_square;
    if (!step.is_outlier) return;
    step.loss = loss_of(step.innovation, slip, step.tracker_covariance, huber_limit(step), robust_);
    covariance_ *= step.loss.slip;
    step.covariance = step.loss.slip * slip + step.loss.tracker * step.tracker_covariance;
    step.weight = inverse(step.covariance);
    step.chi_square = dot(step.innovation, product(step.weight, step.innovation));
  }

  const Unknowns& u_;
  const NoiseModel& noise_;
  const RobustMode robust_;
  const TruthUse truth_;
  const bool has_headings_;
  const std::span<Accumulator* const> accumulators_;
  double x_m_, y_m_, theta_rad_;
  Direction heading_;  // of theta_rad_
  Symmetric3 covariance_;
};

}  // namespace

Matrix3 Update::with_state(const Symmetric3& p) const {
  Matrix3 out = times_shear(p, -lever_y_m, lever_x_m);
  if (!has_heading) out[0][2] = out[1][2] = out[2][2] = 0;
  return out;
}

void filter_run(const Moves& moves, const NoiseModel& noise, RobustMode robust, TruthUse truth,
                const SampleSelection& samples, std::span<Accumulator* const> accumulators) {
  KalmanFilter filter(moves, noise, robust, truth, accumulators);
  const PreparedRun& run = moves.run();
  std::array<double, 4> spent_s{};  // by Motion
  for (const Leg& leg : moves.legs()) {
    if (leg.moved) filter.predict(leg.move);
    if (leg.unknown_m2 > 0) filter.lose_place(leg.unknown_m2, leg.unknown_rad2);
    for (std::size_t motion = 0; motion < spent_s.size(); ++motion) spent_s[motion] += leg.spent_s[motion];
    const std::size_t i = leg.sample;
    if (!samples.takes(run.knots_m, i)) continue;
    const auto most = std::max_element(spent_s.begin(), spent_s.end());
    filter.update(run.truth[i], *most > 0 ? static_cast<Motion>(most - spent_s.begin()) : run.motion[i]);
    spent_s.fill(0);
  }
}

}  // namespace astro::calibration
