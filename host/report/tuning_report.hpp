#pragma once

#include <array>
#include <string>
#include <vector>

#include "host/motor/model/motor_model.hpp"
#include "host/motor/model/prediction.hpp"
#include "host/report/report.hpp"

/// The report of a tuning: the motor models, the gains designed from them, and the predicted and measured
/// responses to steps of speed. One HTML file like the calibration's, from the same template.
namespace astro::report {

struct MotorFigure {
  std::string wheel;  // "left"
  motor::MotorFit fit;
  double breakaway_forward_V = 0, breakaway_backward_V = 0;  // NaN: not seen
};

/// The response of one wheel. Series of equal length; `measured_mps` is empty where only a prediction is shown.
struct StepLines {
  std::vector<double> time_s, set_point_mps, measured_mps, predicted_mps;
  motor::StepFigures measured, predicted;
};

struct StepFigure {
  std::string title;                // "before", "with the new gains"
  std::array<StepLines, 2> wheels;  // left, right
};

struct TuningInput {
  std::string title;
  std::vector<DescriptionRow> description;  // the robot and how it was measured
  std::array<MotorFigure, 2> motors;
  std::vector<ParameterRow> parameters;
  std::vector<DescriptionRow> loop;  // the design in words: bandwidth, margins
  std::vector<StepFigure> steps;
  std::vector<std::string> notes;
};

/// Equal inputs give equal bytes; every text of the input is escaped.
std::string render_tuning_html(const TuningInput& input);

}  // namespace astro::report
