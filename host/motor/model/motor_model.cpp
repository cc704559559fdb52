#include "host/motor/model/motor_model.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "host/base/error.hpp"
#include "host/base/order_statistics.hpp"

namespace astro::motor {
namespace {

constexpr double kWindow_s = 0.1;
constexpr double kSamplesPerWindow = 20;
constexpr std::size_t kSlices = 8;  // of a window: the wheel must be seen turning in each
constexpr std::size_t kLeastWindows = 20;
constexpr Eigen::Index kNeighbours = 6;
constexpr int kPasses = 5;

// phi = (1 - u^2)^3 on [-1, 1].
double bump(double u) { return std::pow(1 - u * u, 3); }
double bump_slope(double u) { return -6 * u * (1 - u * u) * (1 - u * u); }
double bump_integral(double u) { return u - std::pow(u, 3) + 0.6 * std::pow(u, 5) - std::pow(u, 7) / 7; }

// +1 or -1 if the wheel turned that way in every slice, otherwise 0. Missing samples do not count as motion.
double sense_of(std::span<const Sample> window, double count_m) {
  double sense = 0;
  for (std::size_t slice = 0; slice < kSlices; ++slice) {
    const Sample& begin = window[slice * (window.size() - 1) / kSlices];
    const Sample& end = window[(slice + 1) * (window.size() - 1) / kSlices];
    const double moved = (end.position_m - begin.position_m) / count_m;
    if (std::abs(moved) < 0.5 || moved * sense < 0) return 0;
    sense = std::copysign(1.0, moved);
  }
  return sense;
}

Window weigh(std::span<const Sample> samples, double sense) {
  const double half_s = (samples.back().time_s - samples.front().time_s) / 2;
  const double middle_s = samples.front().time_s + half_s;
  const auto u = [&](const Sample& sample) { return (sample.time_s - middle_s) / half_s; };
  Window sum{0, sense, 0, 0};
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    const double from = u(samples[i]), to = u(samples[i + 1]);
    const double position_m = (samples[i].position_m + samples[i + 1].position_m) / 2 - samples[0].position_m;
    sum.voltage_V += samples[i].voltage_V * (bump_integral(to) - bump_integral(from));
    sum.speed_mps -= position_m * (bump(to) - bump(from)) / half_s;
    sum.acceleration_mps2 += position_m * (bump_slope(to) - bump_slope(from)) / (half_s * half_s);
  }
  const double whole = bump_integral(1) - bump_integral(-1);
  sum.voltage_V /= whole;
  sum.speed_mps /= whole;
  sum.acceleration_mps2 /= whole;
  return sum;
}

/// A measured window, and the same window of a simulated wheel that obeys the model: the instrument.
struct Pair {
  Window seen, model;
};

struct Solution {
  MotorModel model;
  Eigen::Vector3d standard_error;
  Eigen::VectorXd residual;
};

struct Equations {
  Eigen::MatrixXd rows, instruments;
  Eigen::VectorXd voltage;
};

Equations equations_of(const std::vector<Pair>& windows) {
  const auto count = static_cast<Eigen::Index>(windows.size());
  Equations equations{Eigen::MatrixXd(count, 3), Eigen::MatrixXd(count, 3), Eigen::VectorXd(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& [seen, model] = windows[static_cast<std::size_t>(i)];
    equations.rows.row(i) << seen.sense, seen.speed_mps, seen.acceleration_mps2;
    equations.instruments.row(i) << seen.sense, model.speed_mps, model.acceleration_mps2;
    equations.voltage[i] = seen.voltage_V;
  }
  return equations;
}

// The estimator of Newey and West, because neighbouring windows overlap by half and have similar model errors.
Eigen::Vector3d standard_errors(const Equations& equations, const Eigen::VectorXd& residual,
                                const Eigen::Matrix3d& inverse) {
  Eigen::Matrix3d meat = Eigen::Matrix3d::Zero();
  const Eigen::MatrixXd& z = equations.instruments;
  const auto count = z.rows();
  for (Eigen::Index lag = 0; lag <= kNeighbours; ++lag) {
    const double weight = 1.0 - static_cast<double>(lag) / (kNeighbours + 1.0);
    for (Eigen::Index i = lag; i < count; ++i) {
      const Eigen::Matrix3d outer = residual[i] * residual[i - lag] * z.row(i).transpose() * z.row(i - lag);
      meat += lag == 0 ? outer : Eigen::Matrix3d(weight * (outer + outer.transpose()));
    }
  }
  const double freedom = static_cast<double>(count) / static_cast<double>(count - 3);
  return (freedom * (inverse * meat * inverse.transpose()).diagonal()).cwiseMax(0).cwiseSqrt();
}

Solution solve(const std::vector<Pair>& windows) {
  if (windows.size() < kLeastWindows)
    throw Error("turned too little to be measured: allow more distance or more voltage",
                MotorProblem::turned_too_little);
  const Equations equations = equations_of(windows);
  const Eigen::Matrix3d inverse = (equations.instruments.transpose() * equations.rows).inverse();
  const Eigen::Vector3d k = inverse * (equations.instruments.transpose() * equations.voltage);
  if (!k.allFinite()) throw Error("turned too evenly to be measured: allow more distance or more voltage");
  const Eigen::VectorXd residual = equations.voltage - equations.rows * k;
  return {{k[0], k[1], k[2]}, standard_errors(equations, residual, inverse), residual};
}

// The position of a simulated wheel that obeys the model under the applied voltages. It has no encoder steps.
std::vector<Sample> simulated(const MotorModel& model, std::span<const Sample> samples) {
  std::vector<Sample> course(samples.begin(), samples.end());
  double speed = 0, position = 0;
  for (std::size_t i = 0; i < course.size(); ++i) {
    course[i].position_m = position;
    if (i + 1 == course.size()) break;
    const double voltage = course[i].voltage_V, length_s = course[i + 1].time_s - course[i].time_s;
    if (speed == 0 && std::abs(voltage) <= model.kS) continue;
    const double sense = speed != 0 ? speed : voltage;
    const double end = (voltage - std::copysign(model.kS, sense)) / model.kV;
    const double next = end + (speed - end) * std::exp(-length_s / model.time_constant_s());
    const double then = next * sense < 0 ? 0 : next;
    position += (speed + then) / 2 * length_s;
    speed = then;
  }
  return course;
}

struct Range {
  std::size_t begin, size;
};

std::vector<Range> turning_ranges(std::span<const Sample> samples, double count_m) {
  std::vector<Range> ranges;
  if (samples.size() < 2) return ranges;
  const double length_s = std::max(kWindow_s, kSamplesPerWindow * median_period_s(samples));
  std::size_t begin = 0, end = 0;
  while (end < samples.size()) {
    while (end < samples.size() && samples[end].time_s < samples[begin].time_s + length_s - 1e-6) ++end;
    if (end == samples.size()) break;
    const Range range{begin, end - begin + 1};
    const auto window = samples.subspan(range.begin, range.size);
    const bool whole =
        window.size() > kSlices && window.back().time_s - window.front().time_s < 1.1 * length_s;
    if (whole && sense_of(window, count_m) != 0) ranges.push_back(range);
    const double next_s = samples[begin].time_s + length_s / 2 - 1e-6;
    while (begin < end && samples[begin].time_s < next_s) ++begin;
  }
  return ranges;
}

std::vector<Window> weighed(std::span<const Sample> samples, const std::vector<Range>& ranges,
                            double count_m) {
  std::vector<Window> windows;
  for (const auto& [begin, size] : ranges) {
    const auto window = samples.subspan(begin, size);
    windows.push_back(weigh(window, sense_of(window, count_m)));
  }
  return windows;
}

// kS + kA a is the motor's voltage minus its back-EMF. Below half of kS the motor soon brakes. The model's
// acceleration decides, because the measured one is noisy and would select windows that err to one side.
std::vector<Pair> driving(const std::vector<Window>& seen, const std::vector<Window>& model,
                          double slowest_mps2) {
  std::vector<Pair> windows;
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (model[i].acceleration_mps2 * seen[i].sense >= slowest_mps2) windows.push_back({seen[i], model[i]});
  return windows;
}

double r_squared(const std::vector<Pair>& windows, const Eigen::VectorXd& residual) {
  double mean = 0, spread = 0;
  for (const auto& [seen, model] : windows) mean += seen.voltage_V / static_cast<double>(windows.size());
  for (const auto& [seen, model] : windows) spread += std::pow(seen.voltage_V - mean, 2);
  return 1 - residual.squaredNorm() / spread;
}

void check(const MotorModel& model) {
  if (!(model.kV > 0) || !(model.kA > 0))
    throw Error("does not follow its voltage", MotorProblem::does_not_follow);
}

}  // namespace

MotorFit fit_motor(std::span<const Sample> samples, double count_m) {
  const std::vector<Range> ranges = turning_ranges(samples, count_m);
  const std::vector<Window> seen = weighed(samples, ranges, count_m);
  std::vector<Pair> windows = driving(seen, seen, 0);
  Solution solution = solve(windows);
  for (int pass = 0; pass < kPasses; ++pass) {
    check(solution.model);
    const std::vector<Sample> course = simulated(solution.model, samples);
    const double slowest_mps2 = -0.5 * std::max(0.0, solution.model.kS) / solution.model.kA;
    windows = driving(seen, weighed(course, ranges, count_m), slowest_mps2);
    solution = solve(windows);
  }
  check(solution.model);
  const Eigen::Vector3d& error = solution.standard_error;
  MotorFit fit{solution.model, {error[0], error[1], error[2]}, 0, 0, {}};
  fit.residual_V = std::sqrt(solution.residual.squaredNorm() / static_cast<double>(windows.size()));
  fit.r_squared = r_squared(windows, solution.residual);
  for (const Pair& window : windows) fit.windows.push_back(window.seen);
  return fit;
}

std::optional<double> breakaway_V(std::span<const Sample> rise, double count_m) {
  constexpr double kSure_counts = 6;  // more than a touch or a settling gear causes
  if (rise.empty()) return std::nullopt;
  const double start_m = rise.front().position_m;
  const auto moved = [&](const Sample& sample) { return (sample.position_m - start_m) / count_m; };
  const auto sure = std::find_if(rise.begin(), rise.end(),
                                 [&](const Sample& s) { return std::abs(moved(s)) >= kSure_counts; });
  if (sure == rise.end()) return std::nullopt;
  const double sense = std::copysign(1.0, moved(*sure));
  auto first = sure;
  while (first != rise.begin() && moved(*std::prev(first)) * sense > 0.5) --first;
  return sense * std::abs(first->voltage_V);
}

}  // namespace astro::motor
