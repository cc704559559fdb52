#pragma once

/// Quantiles of Student's t distribution and of chi-square.
namespace astro::calibration {

/// Two-sided 5 % quantile; infinite for less than one degree of freedom.
double student_t_975(int degrees_of_freedom);

/// One-sided 10 % quantile; infinite for less than one degree of freedom.
double student_t_90(int degrees_of_freedom);

/// 95 % quantile of chi-square for 0 to 4 degrees of freedom.
double chi_square_95(int degrees_of_freedom);

}  // namespace astro::calibration
