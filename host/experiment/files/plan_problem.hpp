#pragma once

namespace astro::experiment {

/// Why a plan cannot be driven. All but the first are about plans that are driven until a precision is reached.
enum class PlanProblem {
  out_of_range,  // values: the name in the file of a plan, and the number
  order_of_open_ended,
  method_without_precision,  // value: the method
  truth_without_precision    // value: the source of truth
};

}  // namespace astro::experiment
