#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "host/experiment/files/run_set.hpp"
#include "host/recording/run.hpp"

/// Drives and recordings in Python: arrays in and out.
namespace astro::python {

namespace py = pybind11;

/// A recording under the name that messages call it by.
struct NamedRun {
  std::string name;
  recording::Run run;
};

/// Copies, because a set owns its runs. `sessions`: of each run, or empty.
experiment::RunSet set_of(const std::vector<const NamedRun*>& runs, std::vector<std::string> sessions = {});

void bind_runs(py::module_& module);

}  // namespace astro::python
