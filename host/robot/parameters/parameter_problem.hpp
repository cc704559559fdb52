#pragma once

namespace astro::robot {

/// What is wrong with a parameter. Values: its name; then for out_of_range the value and the limits, and for wrong_length
/// the number of bytes. The last three kinds concern all parameters together; too_many has their number as its value.
enum class ParameterProblem {
  unknown,
  is_text,
  is_number,
  not_a_number,
  not_whole,
  out_of_range,
  wrong_length,
  too_many,
  changed_by_another,
  set_unknown
};

}  // namespace astro::robot
