#pragma once

#include <string>

/// Numbers for the reader of a report: with a minus sign instead of a hyphen, an en dash for unknown values, and
/// no more digits than the standard error supports.
namespace astro::report {

/// "-12.30" -> "−12.30"; NaN -> "–"; never "−0.00".
std::string fixed(double value, int decimals);

/// Decimals that show two digits of a standard error: 26.3 -> 0, 3.2 -> 1, 0.00012 -> 5. `otherwise` where
/// the error is unknown or zero.
int decimals_for(double standard_error, int otherwise);

/// "405 ± 26"; without the second part where the error is unknown.
std::string with_error(double value, double standard_error, int decimals_if_unknown);

/// Six significant digits at least and never an exponent: 1.00208, 0.289340.
int six_digits(double value);

/// Decimals that show a factor with two or three digits: 0.52, 4.5, 11.
int factor_decimals(double value);

}  // namespace astro::report
