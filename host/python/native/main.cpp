#include "host/base/error.hpp"
#include "host/python/native/calibrations.hpp"
#include "host/python/native/runs.hpp"
#include "host/python/native/simulations.hpp"

namespace astro::python {
namespace {

/// The same sentence and values in Python.
void raise_data_error(const Error& error) {
  const py::object kind = py::module_::import("astrolabe.errors").attr("DataError");
  PyErr_SetObject(kind.ptr(), kind(error.what(), error.values()).ptr());
}

}  // namespace
}  // namespace astro::python

PYBIND11_MODULE(_native, module) {
  namespace python = astro::python;
  pybind11::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const astro::Error& error) {
      python::raise_data_error(error);
    }
  });
  python::bind_runs(module);
  python::bind_calibrations(module);
  python::bind_simulations(module);
}
