#include <fmt/format.h>

#include <cmath>

#include "host/base/degrees.hpp"
#include "host/calibration/likelihood/maximum_likelihood.hpp"

namespace astro::calibration {
namespace {

std::string outlier_sentence(const RunFit& run) {
  return fmt::format(
      "{} disagrees with the others about the factors (chi-square {:.0f} of {}): a slip, a push or a wrong "
      "ground truth; "
      "look at it, and leave it out with --without if so",
      run.name, run.disagreement, run.disagreement_dof);
}

std::string jolt_sentence(const RunFit& run) {
  std::vector<std::string> moments;
  for (const Jolt& jolt : run.jolts)
    moments.push_back(
        fmt::format("{:.1f} s after its start by {:.1f}°", jolt.since_start_s, degrees(jolt.turned_rad)));
  return fmt::format(
      "{}: the ground truth turned and the wheels did not, {}: a castor, a cable, a hand, or markers taken "
      "for "
      "others; look there, and leave the run out with --without if it was an accident",
      run.name, fmt::join(moments, " and "));
}

std::string wheelbase_sentence(const WheelbaseByKind& kind) {
  return fmt::format(
      "arcs want a wheelbase {:.2f} ± {:.2f} % {} than spins: this b lies between; calibrate with the motion "
      "that the "
      "robot will use most",
      100 * std::abs(kind.arc_over_spin - 1), 100 * kind.standard_error,
      kind.arc_over_spin > 1 ? "larger" : "smaller");
}

}  // namespace

std::vector<std::string> MlEstimate::remarks() const {
  std::vector<std::string> sentences;
  for (const std::string& why : left_out) sentences.push_back(why + "; it was left out");
  for (const RunFit& run : runs)
    if (run.outlier) sentences.push_back(outlier_sentence(run));
  for (const RunFit& run : runs)
    if (!run.jolts.empty()) sentences.push_back(jolt_sentence(run));
  const double ratio = chi_square / degrees_of_freedom;
  if (ratio < 0.5)
    sentences.push_back(fmt::format(
        "the ground truth is only {:.2g} times as far from the wheels as the given noise explains, "
        "so the standard errors are too large: let the noise be estimated",
        std::sqrt(ratio)));
  if (ratio > 1.5)
    sentences.push_back(
        fmt::format("the ground truth is {:.1f} times as far from the wheels as the given noise explains, so "
                    "the standard errors are too "
                    "small: let the noise be estimated",
                    std::sqrt(ratio)));
  if (dispersion > 1)
    sentences.push_back(
        fmt::format("the runs differ {:.1f} times as much as the noise within them explains; the standard "
                    "errors are widened by that",
                    std::sqrt(dispersion)));
  if (wheelbase_by_kind && wheelbase_by_kind->disagrees)
    sentences.push_back(wheelbase_sentence(*wheelbase_by_kind));
  return sentences;
}

}  // namespace astro::calibration
