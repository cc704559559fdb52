#include "host/calibration/judgement/remarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "host/base/text/degrees.hpp"

namespace astro::calibration {
namespace {

Remark outlier_remark(const RunFit& run) {
  return {fmt::format("{} disagrees with the others about the factors (chi-square {:.0f} of {}): a slip, a "
                      "push or a wrong "
                      "ground truth",
                      run.name, run.disagreement, run.disagreement_dof),
          JudgementProblem::run_stands_out,
          {run.name}};
}

Remark slip_remark(const RunFit& run) {
  std::vector<std::string> moments, values{run.name};
  for (const SlipEvent& event : run.slip_events) {
    const std::string when_s = fmt::format("{:.1f}", event.since_start_s),
                      turned_deg = fmt::format("{:.1f}", degrees(event.turned_rad));
    moments.push_back(when_s + " s after its start by " + turned_deg + "°");
    values.insert(values.end(), {when_s, turned_deg});
  }
  return {fmt::format("{}: the ground truth turned and the wheels did not, {}: a castor, a cable, a hand, or "
                      "markers taken "
                      "for "
                      "others",
                      run.name, fmt::join(moments, " and ")),
          JudgementProblem::run_slipped, values};
}

// Quartz clocks differ by 100 parts in a million at most.
constexpr double kMostQuartz = 5e-4;

Remark skew_remark(double ppm) {
  const std::string apart = fmt::format("{:.0f}", std::abs(ppm));
  return {
      fmt::format(
          "the robot's clock runs {} ppm {} than that of the ground truth, and quartz clocks differ by 100: "
          "the times of one of them are not those of a clock, or the two are not of one drive",
          apart, ppm < 0 ? "slower" : "faster"),
      JudgementProblem::clocks_run_apart,
      {apart}};
}

/// What is wrong with drives of which only the ends were measured does not show in a chi-square, from which their slip is found,
/// but in a slip that no robot has.
std::optional<Remark> remark_on_slip(const MlEstimate& estimate) {
  constexpr double kMostTimes = 16;  // four times as far as usual; robots on carpet slip half of that
  const double times = estimate.noise.K_m / NoiseModel{}.K_m;
  if (!(times > kMostTimes)) return std::nullopt;
  double sum = 0;
  for (const RunFit& run : estimate.runs) sum += run.chi_square;
  const auto farthest = std::ranges::max_element(estimate.runs, {}, &RunFit::chi_square);
  const std::string shown = fmt::format("{:.0f}", times);
  Remark remark{"the wheels would slip " + shown +
                    " times as much as those of usual robots: left and right wheels may be exchanged, or a "
                    "pose is mistyped or of another drive",
                JudgementProblem::slips_too_much,
                {shown}};
  if (2 * farthest->chi_square > sum) {
    remark.sentence += ", most likely of " + farthest->name;
    remark.values.push_back(farthest->name);
  }
  return remark;
}

}  // namespace

std::optional<double> skew_beyond(const SessionFit& session, double most) {
  constexpr double kSigmas = 3;
  if (std::abs(session.clock_skew) - kSigmas * session.clock_skew_se > most) return 1e6 * session.clock_skew;
  return std::nullopt;
}

Shown two_wheelbases(double e, double standard_error) {
  constexpr double kPerhaps = 2, kClearly = 3;
  const double ratio = std::abs(e) / standard_error;
  if (ratio < kPerhaps) return Shown::no;
  return ratio < kClearly ? Shown::perhaps : Shown::clearly;
}

std::vector<Remark> remarks(const MlEstimate& estimate, bool noise_given) {
  std::vector<Remark> list;
  for (const Remark& why : estimate.left_out) list.push_back(why.in("left out: "));
  list.insert(list.end(), estimate.mended.begin(), estimate.mended.end());
  for (const RunFit& run : estimate.runs)
    if (run.outlier) list.push_back(outlier_remark(run));
  for (const RunFit& run : estimate.runs)
    if (!run.slip_events.empty()) list.push_back(slip_remark(run));
  for (const SessionFit& session : estimate.sessions)
    if (const auto ppm = skew_beyond(session, kMostQuartz)) list.push_back(skew_remark(*ppm));
  const double ratio = estimate.chi_square / estimate.degrees_of_freedom;
  const char* const noise = noise_given ? "given" : "estimated";
  const JudgementProblem noise_problem =
      noise_given ? JudgementProblem::given_noise_is_wrong : JudgementProblem::estimated_noise_is_wrong;
  const bool comparable = !estimate.ends_only;  // their slip is found from this very ratio
  if (comparable && ratio < 0.5)
    list.push_back({fmt::format("the ground truth is only {:.2g} times as far from the wheels as the {} "
                                "noise explains, so the standard errors are too large",
                                std::sqrt(ratio), noise),
                    noise_problem});
  if (comparable && ratio > 1.5)
    list.push_back(
        {fmt::format("the ground truth is {:.1f} times as far from the wheels as the {} noise "
                     "explains, so the standard errors are too small{}",
                     std::sqrt(ratio), noise,
                     noise_given ? ""
                                 : "; look for a run whose chi²/dof is far above the others', for slip, and "
                                   "for truth of another drive"),
         noise_problem});
  if (estimate.ends_only && !noise_given)
    if (auto remark = remark_on_slip(estimate)) list.push_back(*std::move(remark));
  if (estimate.dispersion > 1)
    list.push_back(
        {fmt::format("the runs differ {:.1f} times as much as the noise within them explains; the standard "
                     "errors are widened by that",
                     std::sqrt(estimate.dispersion)),
         JudgementProblem::runs_differ});
  return list;
}

}  // namespace astro::calibration
