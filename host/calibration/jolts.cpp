#include "host/calibration/jolts.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "host/calibration/median_period.hpp"
#include "host/calibration/path_alignment.hpp"

namespace astro::calibration {
namespace {

constexpr double kWindow_s = 0.5;
constexpr int kFewestSamples = 8;    // of a window: fewer and their median follows one that is wrong
constexpr int kStepsPerWindow = 10;  // moments that are looked at
constexpr double kFar = 8;           // in standard deviations of all moments
// Windows on either side over which a jolt lasts. Where clocks do not fit, truth and wheels part for the time
// of a spin and come back together.
constexpr double kLasting = 3;
constexpr double kLeast_rad = 0.02, kLeastWheelbases = 0.03;
constexpr std::size_t kMost = 3;

struct Parting {
  std::size_t at = 0;                             // sample of truth
  Eigen::Vector3d by = Eigen::Vector3d::Zero();   // ahead, left, counter-clockwise
  Eigen::Vector3d far = Eigen::Vector3d::Zero();  // the same in units of what is far
  double size() const { return std::max(far.head<2>().norm(), std::abs(far[2])); }
};

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Poses as one part of a run's truth tells them, carried by the wheels to one moment.
class Told {
 public:
  void add(double x_m, double y_m, double theta_rad) {
    if (values_[2].empty()) first_rad_ = theta_rad;
    values_[0].push_back(x_m);
    values_[1].push_back(y_m);
    values_[2].push_back(std::remainder(theta_rad - first_rad_, 2 * std::numbers::pi));
  }
  int count() const { return static_cast<int>(values_[0].size()); }
  Eigen::Vector3d pose() { return {median(values_[0]), median(values_[1]), first_rad_ + median(values_[2])}; }

 private:
  std::vector<double> values_[3];
  double first_rad_ = 0;
};

/// Where the robot is at `to` if it was where truth had it at `from`.
void carry(const BodySample& truth, const Unknowns& u, const BodySample& from, const BodySample& to,
           Told& told) {
  const double theta = truth.theta_rad - u[kLeverYaw], c = std::cos(theta), s = std::sin(theta);
  const double turn = theta - from.theta_rad, ct = std::cos(turn), st = std::sin(turn);
  const double dx = to.x_m - from.x_m, dy = to.y_m - from.y_m;
  told.add(truth.x_m - c * u[kLeverX] + s * u[kLeverY] + ct * dx - st * dy,
           truth.y_m - s * u[kLeverX] - c * u[kLeverY] + st * dx + ct * dy, turn + to.theta_rad);
}

/// Compares what truth says before and after the moments of a run.
class Moments {
 public:
  Moments(const PreparedRun& run, const Unknowns& u)
      : run_(run),
        u_(u),
        odometry_(dead_reckoned(run, {u[kClockOffset], u[kSkew]}, {u[kCRight], u[kCLeft], u[kB]})),
        window_s_(window_of(run)) {}

  static double window_of(const PreparedRun& run) {
    return std::max(kWindow_s, kFewestSamples * median_period_s(run.truth));
  }

  /// What lies in a window that begins `gap` windows after a sample, less what lies in one that ends as long
  /// before it. Nothing if truth is lost there.
  std::optional<Parting> parting(std::size_t at, double gap) const {
    const double time_s = run_.truth[at].time_s;
    const double near_s = gap * window_s_, far_s = near_s + window_s_;
    Told before, after;
    for (std::size_t k = at; k-- > 0 && run_.truth[k].time_s >= time_s - far_s;)
      if (run_.truth[k].time_s < time_s - near_s)
        carry(run_.truth[k], u_, odometry_[k], odometry_[at], before);
    for (std::size_t k = at; k < run_.truth.size() && run_.truth[k].time_s < time_s + far_s; ++k)
      if (run_.truth[k].time_s >= time_s + near_s)
        carry(run_.truth[k], u_, odometry_[k], odometry_[at], after);
    if (before.count() < kFewestSamples || after.count() < kFewestSamples) return {};
    const Eigen::Vector3d was = before.pose(), is = after.pose();
    const double c = std::cos(was[2]), s = std::sin(was[2]), dx = is[0] - was[0], dy = is[1] - was[1];
    return Parting{at,
                   {c * dx + s * dy, -s * dx + c * dy, std::remainder(is[2] - was[2], 2 * std::numbers::pi)}};
  }

  std::vector<Parting> all() const {
    std::vector<Parting> found;
    const auto samples = static_cast<std::size_t>(window_s_ / median_period_s(run_.truth));
    for (std::size_t at = 0; at < run_.truth.size();
         at += std::max<std::size_t>(1, samples / kStepsPerWindow))
      if (run_.motion[at] != Motion::rest)
        if (const auto here = parting(at, 0)) found.push_back(*here);
    return found;
  }

 private:
  const PreparedRun& run_;
  const Unknowns& u_;
  std::vector<BodySample> odometry_;
  double window_s_;
};

/// Of what is mostly normal.
double robust_deviation(std::vector<double>& values) {
  constexpr double kMedianOfNormal = 0.6745;
  if (values.empty()) return 0;
  for (double& value : values) value = std::abs(value);
  return median(values) / kMedianOfNormal;
}

/// Of several moments of one jolt the one at which it is largest.
std::vector<Jolt> largest(const Moments& moments, const PreparedRun& run, std::vector<Parting> candidates,
                          const Eigen::Vector3d& far) {
  const auto time_s = [&](const Parting& parting) { return run.truth[parting.at].time_s; };
  std::vector<Jolt> found;
  while (!candidates.empty() && found.size() < kMost) {
    const Parting here = *std::max_element(candidates.begin(), candidates.end(),
                                           [](const auto& a, const auto& b) { return a.size() < b.size(); });
    const auto lasting = moments.parting(here.at, kLasting);
    if (lasting && lasting->by.cwiseQuotient(far).dot(here.far) > here.far.squaredNorm() / 2)
      found.push_back({time_s(here), time_s(here) - run.source->truth.front().time_s, here.by[2],
                       here.by.head<2>().norm()});
    std::erase_if(candidates, [&](const Parting& other) {
      return std::abs(time_s(other) - time_s(here)) < 2 * Moments::window_of(run);
    });
  }
  std::sort(found.begin(), found.end(), [](const Jolt& a, const Jolt& b) { return a.time_s < b.time_s; });
  return found;
}

}  // namespace

std::vector<std::vector<Jolt>> jolts(std::span<const PreparedRun> runs, std::span<const Unknowns> unknowns) {
  std::vector<std::vector<Parting>> all(runs.size());
  std::vector<double> moved, turned;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!runs[i].has_headings || runs[i].truth.size() < 2 * kFewestSamples) continue;
    all[i] = Moments(runs[i], unknowns[i]).all();
    for (const Parting& parting : all[i]) {
      moved.insert(moved.end(), {parting.by[0], parting.by[1]});
      turned.push_back(parting.by[2]);
    }
  }
  const double far_rad = std::max(kLeast_rad, kFar * robust_deviation(turned));
  const double far_m = std::max(kLeastWheelbases * unknowns.front()[kB], kFar * robust_deviation(moved));
  const Eigen::Vector3d far(far_m, far_m, far_rad);
  std::vector<std::vector<Jolt>> found(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    for (Parting& parting : all[i]) parting.far = parting.by.cwiseQuotient(far);
    std::erase_if(all[i], [](const Parting& parting) { return parting.size() < 1; });
    if (!all[i].empty()) found[i] = largest(Moments(runs[i], unknowns[i]), runs[i], all[i], far);
  }
  return found;
}

}  // namespace astro::calibration
