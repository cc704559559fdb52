#pragma once

#include <optional>
#include <string>

#include "host/calibration/motion/wheel_factors.hpp"
#include "host/experiment/files/number_named.hpp"

namespace astro::experiment {

/// What is wrong with an e or a kappa0. Values: its source, its name, and the value found there.
enum class CurvatureProblem { of_no_robot, is_text };

/// `factors` with e and kappa0; without them a robot turns every arc about b (e = 0). `where`: what the numbers are from,
/// for the error: "the recording 'line 1'".
///
/// Throws astro::Error for numbers that no robot has.
calibration::WheelFactors with_curvature(calibration::WheelFactors factors, std::optional<double> e,
                                         std::optional<double> kappa0, const std::string& where);

/// Throws astro::Error if what is called `name` is text.
void require_no_text(const NamedValues& values, const std::string& name, const std::string& where);
inline void require_no_text(const std::map<std::string, double>&, const std::string&, const std::string&) {}

/// The same as with_curvature, from values by the parameters' names. Throws for text, too.
template <class Values>
calibration::WheelFactors with_curvature_named(const calibration::WheelFactors& factors, const Values& values,
                                               const std::string& where) {
  require_no_text(values, "e", where);
  require_no_text(values, "kappa0", where);
  return with_curvature(factors, number_named(values, "e"), number_named(values, "kappa0"), where);
}

}  // namespace astro::experiment
