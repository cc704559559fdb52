#include "host/report/series.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace astro::report {

namespace {

constexpr std::int64_t kLongestGap_us = 200'000;

struct Pose {
  double x_m = 0, y_m = 0, theta_rad = 0;
};

/// Looks truth up at ascending times.
class TruthReader {
 public:
  explicit TruthReader(const std::vector<recording::TruthSample>& samples) : samples_(samples) {}

  std::optional<Pose> at(std::int64_t time_us) {
    while (next_ < samples_.size() && samples_[next_].time_us < time_us) ++next_;
    if (next_ == samples_.size()) return {};
    const auto& b = samples_[next_];
    if (b.time_us == time_us) return b.valid ? std::optional(Pose{b.x_m, b.y_m, b.theta_rad}) : std::nullopt;
    if (next_ == 0) return {};
    const auto& a = samples_[next_ - 1];
    if (!a.valid || !b.valid || b.time_us - a.time_us > kLongestGap_us) return {};
    const double f = static_cast<double>(time_us - a.time_us) / static_cast<double>(b.time_us - a.time_us);
    return Pose{std::lerp(a.x_m, b.x_m, f), std::lerp(a.y_m, b.y_m, f),
                std::lerp(a.theta_rad, b.theta_rad, f)};
  }

 private:
  const std::vector<recording::TruthSample>& samples_;
  std::size_t next_ = 0;
};

Pose seen_from(const Pose& origin, const Pose& pose) {
  const double dx = pose.x_m - origin.x_m, dy = pose.y_m - origin.y_m;
  const double c = std::cos(origin.theta_rad), s = std::sin(origin.theta_rad);
  return {c * dx + s * dy, -s * dx + c * dy, pose.theta_rad - origin.theta_rad};
}

Pose pose_of(const recording::OdometrySample& sample) { return {sample.x_m, sample.y_m, sample.theta_rad}; }

}  // namespace

std::vector<PathPoint> align(const recording::Run& run) {
  std::vector<PathPoint> points;
  if (run.odometry.empty()) return points;
  points.reserve(run.odometry.size());

  std::vector<std::optional<Pose>> truths;
  TruthReader reader(run.truth);
  for (const auto& sample : run.odometry) truths.push_back(reader.at(sample.time_us));
  const auto first = std::find_if(truths.begin(), truths.end(), [](const auto& t) { return t.has_value(); });
  const auto start = first == truths.end() ? 0U : static_cast<std::size_t>(first - truths.begin());
  const Pose odometry_start = pose_of(run.odometry[start]);
  const Pose truth_start = truths[start].value_or(Pose{});

  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < run.odometry.size(); ++i) {
    const Pose o = seen_from(odometry_start, pose_of(run.odometry[i]));
    const Pose t = truths[i] ? seen_from(truth_start, *truths[i]) : Pose{kNone, kNone, kNone};
    const auto elapsed_us = run.odometry[i].time_us - run.odometry.front().time_us;
    points.push_back(
        {static_cast<double>(elapsed_us) * 1e-6, o.x_m, o.y_m, o.theta_rad, t.x_m, t.y_m, t.theta_rad});
  }
  return points;
}

std::vector<PathPoint> thin(std::vector<PathPoint> points, std::size_t most) {
  if (points.size() <= most) return points;
  std::vector<PathPoint> kept;
  kept.reserve(most);
  for (std::size_t i = 0; i < most; ++i) kept.push_back(points[i * (points.size() - 1) / (most - 1)]);
  return kept;
}

}  // namespace astro::report
