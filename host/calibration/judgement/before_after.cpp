#include "host/calibration/judgement/before_after.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/calibration/judgement/student_t.hpp"

namespace astro::calibration {
namespace {

constexpr int kPriorRuns = 4;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

double square(double x) { return x * x; }

double quantile(const FigureOfMerit& before, const FigureOfMerit& after) {
  return student_t_975(std::min(before.runs, after.runs) - 1);
}

bool errors_known(const FigureOfMerit& before, const FigureOfMerit& after) {
  return std::isfinite(before.standard_error) && std::isfinite(after.standard_error) && before.runs > 1 &&
         after.runs > 1;
}

}  // namespace

FigureOfMerit E_max_syst_mm(const ExperimentSummary& squares) {
  const int runs = squares.cw.r_cg_m > squares.ccw.r_cg_m ? squares.cw.runs : squares.ccw.runs;
  return {squares.E_max_syst_m * 1e3, squares.se_E_max_syst_m * 1e3, runs};
}

Improvement improvement(const FigureOfMerit& before, const FigureOfMerit& after) {
  const double a = before.value, b = after.value;
  Improvement out{a / b, kUnknown, kUnknown, kUnknown};
  if (!errors_known(before, after)) return out;
  if (b == 0) return {a > 0 ? kInfinity : kUnknown, kUnknown, kUnknown, kUnknown};
  out.standard_error = out.factor * std::hypot(before.standard_error / a, after.standard_error / b);

  // The f with (a - f b)^2 <= k^2 (sa^2 + f^2 sb^2), that is A f^2 - 2 B f + C <= 0.
  const double k2 = square(quantile(before, after));
  const double A = b * b - k2 * square(after.standard_error), B = a * b;
  const double C = a * a - k2 * square(before.standard_error);
  const double root = std::sqrt(std::max(0.0, B * B - A * C));
  out.low = std::max(0.0, C / (B + root));
  out.high = A > 0 ? (B + root) / A : kInfinity;
  return out;
}

Verdict judge(const FigureOfMerit& before, const FigureOfMerit& after) {
  if (!errors_known(before, after)) return Verdict::unknown;
  const double difference = before.value - after.value;
  const double error = std::hypot(before.standard_error, after.standard_error);
  if (std::abs(difference) <= quantile(before, after) * error) return Verdict::undecided;
  return difference > 0 ? Verdict::better : Verdict::worse;
}

Verdict judge_gains(std::span<const double> gains) {
  const auto n = static_cast<double>(gains.size());
  if (gains.size() < 2) return Verdict::unknown;
  if (std::all_of(gains.begin(), gains.end(), [](double gain) { return gain == 0; }))
    return Verdict::undecided;
  double mean = 0, squares = 0;
  for (const double gain : gains) mean += gain / n;
  for (const double gain : gains) squares += (gain - mean) * (gain - mean);
  const int freedom = static_cast<int>(gains.size()) - 1 + kPriorRuns;
  const double variance = (squares + kPriorRuns * 4 * std::abs(mean)) / freedom;
  const double t = mean / std::sqrt(variance / n);
  if (std::isnan(t)) return Verdict::unknown;
  if (std::abs(t) <= student_t_90(freedom)) return Verdict::undecided;
  return t > 0 ? Verdict::better : Verdict::worse;
}

std::optional<int> runs_to_tell(const FigureOfMerit& before, const FigureOfMerit& after) {
  constexpr int kMostRuns = 100;
  if (!errors_known(before, after)) return std::nullopt;
  const auto with = [](FigureOfMerit figure, int runs) {
    figure.standard_error *= std::sqrt(static_cast<double>(figure.runs) / runs);
    figure.runs = runs;
    return figure;
  };
  for (int runs = 2; runs <= kMostRuns; ++runs)
    if (judge(with(before, runs), with(after, runs)) != Verdict::undecided) return runs;
  return std::nullopt;
}

FigureOfMerit root_mean_square(std::span<const double> values) {
  const double n = static_cast<double>(values.size());
  double mean = 0, spread = 0;
  for (const double v : values) mean += square(v) / n;
  for (const double v : values) spread += square(square(v) - mean);
  const double rms = std::sqrt(mean);
  if (n < 2) return {rms, kUnknown, static_cast<int>(n)};
  const double error_of_mean = std::sqrt(spread / (n - 1) / n);
  return {rms, rms > 0 ? error_of_mean / (2 * rms) : 0, static_cast<int>(n)};
}

}  // namespace astro::calibration
