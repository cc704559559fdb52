#pragma once

#include <pybind11/pybind11.h>

/// Factors and how certain they are.
namespace astro::python {

void bind_calibrations(pybind11::module_& module);

}  // namespace astro::python
