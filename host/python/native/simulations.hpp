#pragma once

#include <pybind11/pybind11.h>

/// Simulated robots, and studies of methods.
namespace astro::python {

void bind_simulations(pybind11::module_& module);

}  // namespace astro::python
