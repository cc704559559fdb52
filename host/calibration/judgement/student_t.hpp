#pragma once

/// Quantiles of Student's t distribution.
namespace astro::calibration {

/// Two-sided 5 % quantile; infinite for less than one degree of freedom.
double student_t_975(int degrees_of_freedom);

/// One-sided 10 % quantile; infinite for less than one degree of freedom.
double student_t_90(int degrees_of_freedom);

}  // namespace astro::calibration
