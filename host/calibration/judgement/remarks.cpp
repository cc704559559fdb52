#include "host/calibration/judgement/remarks.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/base/text/degrees.hpp"

namespace astro::calibration {
namespace {

std::string outlier_sentence(const RunFit& run) {
  return fmt::format(
      "{} disagrees with the others about the factors (chi-square {:.0f} of {}): a slip, a push or a wrong "
      "ground truth",
      run.name, run.disagreement, run.disagreement_dof);
}

std::string slip_sentence(const RunFit& run) {
  std::vector<std::string> moments;
  for (const SlipEvent& event : run.slip_events)
    moments.push_back(
        fmt::format("{:.1f} s after its start by {:.1f}°", event.since_start_s, degrees(event.turned_rad)));
  return fmt::format(
      "{}: the ground truth turned and the wheels did not, {}: a castor, a cable, a hand, or markers taken "
      "for "
      "others",
      run.name, fmt::join(moments, " and "));
}

}  // namespace

std::vector<Remark> remarks(const MlEstimate& estimate, bool noise_given) {
  std::vector<Remark> list;
  for (const Remark& why : estimate.left_out) list.push_back(why.in("left out: "));
  for (const RunFit& run : estimate.runs)
    if (run.outlier) list.push_back({outlier_sentence(run), JudgementProblem::run_stands_out});
  for (const RunFit& run : estimate.runs)
    if (!run.slip_events.empty()) list.push_back({slip_sentence(run), JudgementProblem::run_slipped});
  const double ratio = estimate.chi_square / estimate.degrees_of_freedom;
  const char* const noise = noise_given ? "given" : "estimated";
  if (ratio < 0.5)
    list.push_back({fmt::format("the ground truth is only {:.2g} times as far from the wheels as the {} "
                                "noise explains, so the standard errors are too large",
                                std::sqrt(ratio), noise),
                    noise_given ? Kind(JudgementProblem::given_noise_is_wrong) : Kind()});
  if (ratio > 1.5)
    list.push_back(
        {fmt::format("the ground truth is {:.1f} times as far from the wheels as the {} noise "
                     "explains, so the standard errors are too small{}",
                     std::sqrt(ratio), noise,
                     noise_given ? ""
                                 : "; look for a run whose chi²/dof is far above the others', for slip, and "
                                   "for truth of another drive"),
         noise_given ? Kind(JudgementProblem::given_noise_is_wrong) : Kind()});
  if (estimate.dispersion > 1)
    list.push_back(
        {fmt::format("the runs differ {:.1f} times as much as the noise within them explains; the standard "
                     "errors are widened by that",
                     std::sqrt(estimate.dispersion))});
  return list;
}

}  // namespace astro::calibration
