#include "host/simulation/study/synthetic_drive.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "host/calibration/motion/arc.hpp"
#include "host/simulation/robot/normal_deviates.hpp"

namespace astro::simulation::study {
namespace {

using calibration::BodySample;
using calibration::Trajectory;
using calibration::WheelFactors;
using calibration::WheelSample;

// So short that the error of assuming a constant twist per step is far below a micrometre.
constexpr double kStep_s = 1.0 / 600;

/// The whole course at every time step, in robot time.
struct Track {
  std::vector<double> left_m, right_m;  // nominal travel
  std::vector<Pose2> pose;              // of the robot
};

// Fraction of a leg after `time_s` of a trapezoid of the given peak rate and acceleration, both per whole
// leg.
double covered(double time_s, double rate, double acceleration) {
  const double peak = std::min(rate, std::sqrt(acceleration));
  const double ramp_s = peak / acceleration;
  const double total_s = ramp_s + 1 / peak;
  if (time_s >= total_s) return 1;
  if (time_s < ramp_s) return acceleration * time_s * time_s / 2;
  if (time_s > total_s - ramp_s) {
    const double left_s = total_s - time_s;
    return 1 - acceleration * left_s * left_s / 2;
  }
  return peak * (time_s - ramp_s / 2);
}

class Drive {
 public:
  Drive(const DriveModel& model, std::uint64_t seed) : model_(model), random_(seed) { keep(); }

  void follow(const Leg& leg) {
    if (leg.kind == Leg::Kind::rest) {
      for (double t = 0; t < leg.duration_s - kStep_s / 2; t += kStep_s) advance(0, 0);
      return;
    }
    const double length = std::abs(leg.length_m), angle = std::abs(leg.angle_rad);
    const double rate = std::min(length > 0 ? model_.speed_mps / length : 1e9,
                                 angle > 0 ? model_.yaw_rate_radps / angle : 1e9);
    const double acceleration = std::min(length > 0 ? model_.acceleration_mps2 / length : 1e9,
                                         angle > 0 ? model_.yaw_acceleration_radps2 / angle : 1e9);
    const double spin_m = leg.angle_rad * model_.loaded.b_m / 2;
    const double about_m =
        calibration::effective_wheelbase_m(leg.length_m + spin_m, leg.length_m - spin_m, model_.loaded);
    const double half_track_m = leg.angle_rad * about_m / 2;
    double before = 0;
    for (double t = kStep_s; before < 1; t += kStep_s) {
      const double now = covered(t, rate, acceleration);
      advance((leg.length_m - half_track_m) * (now - before) / model_.loaded.c_l,
              (leg.length_m + half_track_m) * (now - before) / model_.loaded.c_r);
      before = now;
    }
  }

  const Track& track() const { return track_; }
  std::mt19937_64& random() { return random_; }

 private:
  double slipped(double factor, double nominal_m) {
    return factor * nominal_m + std::sqrt(model_.noise.K_m * std::abs(nominal_m)) * normal_(random_);
  }

  void advance(double left_m, double right_m) {
    left_m_ += left_m;
    right_m_ += right_m;
    if (left_m != 0 || right_m != 0) {
      // The curvature is that of the wheels without slip, because in a single step slip can be a large part
      // of the travel.
      const double about_m = calibration::effective_wheelbase_m(model_.actual.c_r * right_m,
                                                                model_.actual.c_l * left_m, model_.actual);
      const double l = slipped(model_.actual.c_l, left_m), r = slipped(model_.actual.c_r, right_m);
      calibration::advance(pose_, r, l, about_m);
      if (model_.windup_rad != 0) wind_up(left_m, right_m);
    }
    keep();
  }

  void wind_up(double left_m, double right_m) {
    constexpr double kWithin_m = 3e-3;
    const double way_m = (std::abs(left_m) + std::abs(right_m)) / 2;
    const double target_rad = model_.windup_rad * (right_m - left_m) / (2 * way_m);
    const double change_rad = (target_rad - wound_rad_) * -std::expm1(-way_m / kWithin_m);
    wound_rad_ += change_rad;
    pose_.theta_rad -= change_rad;
  }

  void keep() {
    track_.left_m.push_back(left_m_);
    track_.right_m.push_back(right_m_);
    track_.pose.push_back(pose_);
  }

  const DriveModel& model_;
  std::mt19937_64 random_;
  NormalDeviates normal_;
  double left_m_ = 0, right_m_ = 0, wound_rad_ = 0;
  Pose2 pose_;
  Track track_;
};

double between(double a, double b, double fraction) { return a + fraction * (b - a); }

Pose2 pose_at(const Track& track, double time_s) {
  const double at = std::clamp(time_s / kStep_s, 0.0, static_cast<double>(track.pose.size() - 1));
  const std::size_t i = std::min(static_cast<std::size_t>(at), track.pose.size() - 2);
  const double fraction = at - static_cast<double>(i);
  const Pose2 &a = track.pose[i], &b = track.pose[i + 1];
  return {between(a.x_m, b.x_m, fraction), between(a.y_m, b.y_m, fraction),
          between(a.theta_rad, b.theta_rad, fraction)};
}

double travel_at(const std::vector<double>& travel_m, double time_s) {
  const double at = std::clamp(time_s / kStep_s, 0.0, static_cast<double>(travel_m.size() - 1));
  const std::size_t i = std::min(static_cast<std::size_t>(at), travel_m.size() - 2);
  return between(travel_m[i], travel_m[i + 1], at - static_cast<double>(i));
}

double whole_counts(double travel_m, double metres_per_count) {
  return metres_per_count > 0 ? std::floor(travel_m / metres_per_count) * metres_per_count : travel_m;
}

BodySample seen(const Pose2& robot, const DriveModel& model, std::mt19937_64& random) {
  NormalDeviates normal;
  const Pose2 body = robot * model.lever;
  BodySample sample;
  sample.x_m = body.x_m + model.noise.sigma_xy_m * normal(random);
  sample.y_m = body.y_m + model.noise.sigma_xy_m * normal(random);
  const double heading_rad = body.theta_rad + model.noise.sigma_theta_rad * normal(random);
  if (model.headings) sample.theta_rad = wrapped_rad(heading_rad);
  return sample;
}

Course between_rests(Course path, double rest_s) {
  const Leg rest{Leg::Kind::rest, 0, 0, rest_s};
  path.insert(path.begin(), rest);
  path.push_back(rest);
  return path;
}

Pose2 mean_truth(const std::vector<BodySample>& truth, double from_s, double to_s) {
  Point2 sum;
  double c = 0, s = 0, count = 0;
  for (const BodySample& sample : truth) {
    if (sample.time_s < from_s || sample.time_s > to_s) continue;
    sum.x_m += sample.x_m;
    sum.y_m += sample.y_m;
    c += std::cos(sample.theta_rad);
    s += std::sin(sample.theta_rad);
    ++count;
  }
  return {sum.x_m / count, sum.y_m / count, std::atan2(s, c)};
}

Pose2 dead_reckoned(const std::vector<WheelSample>& wheels, const WheelFactors& loaded) {
  Pose2 pose;
  for (std::size_t i = 1; i < wheels.size(); ++i)
    calibration::advance(pose, wheels[i].right_m - wheels[i - 1].right_m,
                         wheels[i].left_m - wheels[i - 1].left_m, loaded);
  return pose;
}

}  // namespace

Course square_course(double side_m, Sense sense, double rest_s) {
  const double quarter = sign_of(sense) * std::numbers::pi / 2;
  Course path;
  for (int corner = 0; corner < 4; ++corner) {
    path.push_back({Leg::Kind::straight, side_m, 0, 0});
    path.push_back({Leg::Kind::turn, 0, quarter, 0});
  }
  return between_rests(path, rest_s);
}

Course square_course_with_stands(double side_m, Sense sense, double rest_s) {
  const Course square = square_course(side_m, sense, 0);
  Course path;
  for (std::size_t leg = 1; leg + 1 < square.size(); ++leg) {  // without the rests at its ends
    path.push_back(square[leg]);
    if (square[leg].kind == Leg::Kind::turn) path.push_back({Leg::Kind::rest, 0, 0, kStand_s});
  }
  path.push_back({Leg::Kind::straight, kEndLine_m, 0, 0});
  return between_rests(path, rest_s);
}

Course line_course(double length_m, double rest_s) {
  return between_rests({{Leg::Kind::straight, length_m, 0, 0}}, rest_s);
}

Course spin_course(double angle_rad, double rest_s) {
  return between_rests({{Leg::Kind::turn, 0, angle_rad, 0}}, rest_s);
}

Course circle_course(double radius_m, double angle_rad, double rest_s) {
  return between_rests({{Leg::Kind::turn, radius_m * std::abs(angle_rad), angle_rad, 0}}, rest_s);
}

Trajectory synthetic_drive(const Course& course, const DriveModel& model, const std::string& name,
                           std::uint64_t seed) {
  Drive drive(model, seed);
  for (const Leg& leg : course) drive.follow(leg);
  const double end_s = static_cast<double>(drive.track().pose.size() - 1) * kStep_s;

  Trajectory run;
  run.name = name;
  for (int i = 0; i / model.count_rate_hz <= end_s; ++i) {
    const double time_s = i / model.count_rate_hz;
    run.wheels.push_back({time_s,
                          whole_counts(travel_at(drive.track().left_m, time_s), model.metres_per_count),
                          whole_counts(travel_at(drive.track().right_m, time_s), model.metres_per_count)});
  }
  // Robot time u = t + offset + skew (t - middle), solved for t at the first sample.
  const double middle_s = end_s / 2;
  const auto robot_time = [&](double t) {
    return t + model.clock_offset_s + model.clock_skew * (t + model.clock_offset_s - middle_s);
  };
  for (double t = -model.clock_offset_s - std::abs(model.clock_skew) * end_s; robot_time(t) <= end_s;
       t += 1 / model.truth_rate_hz) {
    if (robot_time(t) < 0) continue;
    BodySample sample = seen(pose_at(drive.track(), robot_time(t)), model, drive.random());
    sample.time_s = t;
    run.truth.push_back(sample);
  }
  return run;
}

calibration::EndPose end_error(const Trajectory& run, const WheelFactors& loaded, double rest_s) {
  const double end_s = run.truth.back().time_s, start_s = run.truth.front().time_s;
  const Pose2 from = mean_truth(run.truth, start_s, start_s + 0.9 * rest_s);
  const Pose2 to = mean_truth(run.truth, end_s - 0.9 * rest_s, end_s);
  return difference(from.between(to), dead_reckoned(run.wheels, loaded));
}

std::uint64_t derived_seed(std::uint64_t seed, std::uint64_t index) {
  // SplitMix64 (Steele, Lea, Flood 2014).
  std::uint64_t z = seed + (index + 1) * 0x9E3779B97F4A7C15U;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
  return z ^ (z >> 31);
}

}  // namespace astro::simulation::study
