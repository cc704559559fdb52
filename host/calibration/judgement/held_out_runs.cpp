#include "host/calibration/judgement/held_out_runs.hpp"

#include <fmt/format.h>
#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

#include "host/calibration/judgement/remarks.hpp"
#include "host/calibration/judgement/student_t.hpp"

namespace astro::calibration {
namespace {

// If the factors of all runs are right and they are claimed to be better by this chi-square, they are shown to be better in nine
// sets of ten.
constexpr double kShows = 16;

std::string joined(const std::vector<std::string>& names) {
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i)
    list += (i == 0 ? "" : i + 1 < names.size() ? ", " : " and ") + names[i];
  return list;
}

double claimed_by(const std::vector<HeldOutRun>& runs) {
  double claimed = 0;
  for (const HeldOutRun& run : runs) claimed += run.claimed;
  return claimed;
}

HeldOutErrors root_mean_squares(const std::vector<HeldOutRun>& runs, RunErrors HeldOutRun::*which) {
  const auto over = [&](double RunErrors::*error) {
    double sum = 0, count = 0;
    for (const HeldOutRun& run : runs) {
      const double value = run.*which.*error;
      if (!std::isfinite(value)) continue;
      sum += value * value;
      ++count;
    }
    return std::sqrt(sum / count);
  };
  return {over(&RunErrors::final_m), over(&RunErrors::final_heading_rad), over(&RunErrors::path_rms_m)};
}

}  // namespace

HeldOutErrors CrossValidation::in_use() const { return root_mean_squares(runs, &HeldOutRun::in_use); }
HeldOutErrors CrossValidation::found() const { return root_mean_squares(runs, &HeldOutRun::found); }

int CrossValidation::better_on() const {
  return static_cast<int>(
      std::count_if(runs.begin(), runs.end(), [](const HeldOutRun& run) { return run.gain > 0; }));
}

bool CrossValidation::little_to_gain() const {
  const double claimed = claimed_by(runs) + claimed_elsewhere;
  return within_drift || (claimed > 0 && claimed <= chi_square_95(3));
}

void CrossValidation::judge() {
  std::vector<double> gains;
  double gained = 0;
  for (const HeldOutRun& run : runs) {
    gains.push_back(run.gain);
    gained += run.gain;
  }
  const double claimed = claimed_by(runs);
  verdict = judge_gains(gains);
  if (verdict == Verdict::undecided && claimed > chi_square_95(3) && claimed < kShows)
    not_judged.push_back(
        {"the difference is too small for so few drives: drive more", JudgementProblem::too_few_drives});
  const bool clearly_worse = verdict == Verdict::worse && gained < -claimed_elsewhere;
  if (!not_judged.empty() && !clearly_worse) verdict = Verdict::unknown;
}

void CrossValidation::weigh_against_drift(const Eigen::VectorXd& change, const Eigen::MatrixXd& own,
                                          const Eigen::MatrixXd& another_day) {
  const auto is_within = [&](const Eigen::MatrixXd& covariance) {
    return change.dot(covariance.ldlt().solve(change)) <= chi_square_95(static_cast<int>(change.size()));
  };
  const bool too_few = verdict == Verdict::unknown && not_judged.size() == 1 &&
                       not_judged.front().kind == JudgementProblem::too_few_drives;
  if ((verdict != Verdict::better && !too_few) || !is_within(own + another_day)) return;
  const bool by_drift_alone = is_within(another_day - own);
  if (too_few && !by_drift_alone) return;  // more drives may show a difference
  within_drift = by_drift_alone;
  within_errors_and_drift = !by_drift_alone;
  verdict = Verdict::undecided;
  if (too_few) not_judged.clear();
}

Remark CrossValidation::without(const std::vector<std::string>& held_out, const Error& error) {
  Remark clause = error.in("without " + joined(held_out) + ", ");
  clause.values.insert(clause.values.end(), held_out.begin(), held_out.end());
  return clause;
}

Remark CrossValidation::known_by_these_alone(const std::vector<std::string>& held_out) {
  return {
      fmt::format("what {} shows of wheel ratio, wheelbase and scale, no other drive shows: drive it again",
                  joined(held_out)),
      JudgementProblem::known_by_these_alone, held_out};
}

}  // namespace astro::calibration
