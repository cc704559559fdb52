#include "host/experiment/analysis/method_text.hpp"

#include <fmt/format.h>

#include "host/experiment/analysis/judgement_sentences.hpp"
#include "host/experiment/analysis/likelihood_sentences.hpp"
#include "host/experiment/analysis/scan_sentences.hpp"

namespace astro::experiment {
namespace {

std::string ml_text(const Calibration& calibration) {
  const MlResult& ml = *calibration.ml();
  std::string text =
      extent_sentence(ml) +
      " All recordings up to then count, not only the squares. The factors are absolute: they refer to "
      "the nominal wheel, whatever was loaded in the robot while it drove.\n\n" +
      lever_sentence(ml) + ' ' + clock_sentence(ml) + "\n\n" + wheelbase_sentence(calibration) + ' ' +
      scale_sentence(calibration) + ' ' + noise_sentence(ml) + "\n\n";
  for (const Remark& remark : verdict(ml)) text += remark.sentence + ". ";
  return text;
}

std::string scale_text(const Calibration& calibration) {
  const auto& scale = calibration.line_scale;
  if (!scale)
    return "A closed square is blind to the common scale of both wheels, so c_R + c_L is left as it was.";
  return fmt::format(
      "A closed square is blind to the common scale of both wheels: {} measured line{} gave S = {:.5f} ± "
      "{:.5f}.",
      scale->lines, scale->lines == 1 ? "" : "s", scale->scale, scale->se);
}

std::string end_pose_text(const Calibration& calibration) {
  const calibration::Estimate& estimate = *calibration.end_poses();
  std::string text;
  if (estimate.options.method == calibration::Method::umbmark)
    text += fmt::format(" Angles from: {}.", calibration::name_of(estimate.options.angles));
  if (estimate.options.method == calibration::Method::extended)
    text += fmt::format(" Formula: {}.", calibration::name_of(estimate.options.formula));
  return text +
         "\n\nThe estimate is composed with the factors that were loaded in the robot while it drove. " +
         scale_text(calibration);
}

std::string scans_text(const Calibration& calibration) {
  const lidar::ScanCalibration& scans = *calibration.scans();
  std::string text = matches_sentence(scans) + ' ' + changed_sentence(scans) +
                     "\n\nThe factors are absolute: they refer to the nominal wheel, whatever was loaded in "
                     "the robot while it "
                     "drove.\n\n" +
                     scanner_sentence(scans) + ' ' + wheelbase_sentence(calibration) + ' ' +
                     scale_sentence(calibration) + "\n\n";
  for (const Remark& remark : scans.remarks) text += "Take care: " + remark.sentence + ". ";
  return text;
}

}  // namespace

std::string method_text(const Calibration& calibration) {
  const std::string name = fmt::format("Method: {}.", calibration.method());
  return name +
         (calibration.ml() != nullptr      ? ' ' + ml_text(calibration)
          : calibration.scans() != nullptr ? ' ' + scans_text(calibration)
                                           : end_pose_text(calibration)) +
         "\n\n" + drift_sentence(calibration.drift);
}

}  // namespace astro::experiment
