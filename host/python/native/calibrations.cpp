#include "host/python/native/calibrations.hpp"

#include <pybind11/eigen.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <utility>

#include "host/experiment/analysis/calibration.hpp"
#include "host/experiment/analysis/dead_reckoning.hpp"
#include "host/experiment/analysis/json.hpp"
#include "host/experiment/analysis/judgement_sentences.hpp"
#include "host/experiment/files/method_names.hpp"
#include "host/python/native/runs.hpp"

namespace astro::python {
namespace {

using calibration::WheelFactors;
using experiment::Calibration;
using Covariance = std::optional<calibration::FactorCovariance>;

std::map<std::string, double> errors_of(const experiment::FactorErrors& se) {
  return {{"c_R", se.c_r}, {"c_L", se.c_l},     {"b_m", se.b_m}, {"e", se.e},
          {"E_d", se.E_d}, {"scale", se.scale}, {"E_b", se.E_b}};
}

Covariance covariance_of(const Calibration& found) {
  if (found.ml() != nullptr) return found.ml()->estimate.covariance;
  if (found.scans() != nullptr) return found.scans()->covariance;
  return std::nullopt;
}

Calibration calibrate(const std::vector<const NamedRun*>& runs, const std::string& method,
                      const std::string& clock,
                      const std::optional<std::tuple<double, double, double>>& noise,
                      std::vector<std::string> sessions) {
  using Clock = experiment::MlChoice::Clock;
  experiment::MlChoice choice;
  if (clock != "auto" && clock != "known" && clock != "estimated")
    throw py::value_error("clock must be auto, known or estimated");
  if (clock != "auto") choice.clock = clock == "known" ? Clock::known : Clock::estimated;
  if (noise) choice.noise = {std::get<0>(*noise), std::get<1>(*noise), std::get<2>(*noise)};
  const experiment::RunSet set = set_of(runs, std::move(sessions));
  const py::gil_scoped_release others_run;
  return experiment::calibrate(set, experiment::method_named(method, "thesis", "exact"), choice);
}

py::list dead_reckon(const std::vector<const NamedRun*>& runs, const WheelFactors& factors) {
  using namespace pybind11::literals;  // NOLINT(google-build-using-namespace): _a
  const experiment::RunSet set = set_of(runs);
  const experiment::NamedFactors named[] = {{"given", factors}};
  const std::vector<experiment::DeadReckoning> by = experiment::dead_reckon(set, named);
  py::list errors;
  for (const calibration::RunErrors& run : by.front().errors.runs)
    errors.append(py::dict("name"_a = run.name, "final_m"_a = run.final_m,
                           "final_heading_rad"_a = run.final_heading_rad, "path_rms_m"_a = run.path_rms_m));
  return errors;
}

std::string text_of(const WheelFactors& factors) {
  std::ostringstream text;
  text.precision(17);
  text << "Factors(c_R=" << factors.c_r << ", c_L=" << factors.c_l << ", b_m=" << factors.b_m
       << ", e=" << factors.e << ", kappa0=" << factors.kappa0 << ")";
  return text.str();
}

}  // namespace

void bind_calibrations(py::module_& module) {
  using namespace pybind11::literals;  // NOLINT(google-build-using-namespace): _a
  py::class_<WheelFactors>(module, "Factors")
      .def(py::init<double, double, double, double, double>(), "c_R"_a = 1.0, "c_L"_a = 1.0, "b_m"_a,
           "e"_a = 0.0, "kappa0"_a = calibration::kUsualKappa0)
      .def_readonly("c_R", &WheelFactors::c_r)
      .def_readonly("c_L", &WheelFactors::c_l)
      .def_readonly("b_m", &WheelFactors::b_m)
      .def_readonly("e", &WheelFactors::e)
      .def_readonly("kappa0", &WheelFactors::kappa0)
      .def("__repr__", &text_of);
  py::class_<Calibration>(module, "Calibration")
      .def_readonly("factors", &Calibration::factors)
      .def_readonly("loaded", &Calibration::loaded)
      .def_property_readonly("method", [](const Calibration& found) { return std::string(found.method()); })
      .def_property_readonly("standard_errors", [](const Calibration& found) { return errors_of(found.se); })
      .def_property_readonly("standard_errors_another_day",
                             [](const Calibration& found) { return errors_of(found.se_another_day); })
      .def_property_readonly("covariance", &covariance_of)
      .def_readonly("covariance_another_day", &Calibration::covariance_another_day)
      .def_property_readonly(
          "verdict",
          [](const Calibration& found) { return std::string(experiment::name_of(found.judgement.verdict)); })
      .def_property_readonly(
          "use",
          [](const Calibration& found) { return !experiment::advises_against(found.judgement.verdict); })
      .def_property_readonly("sentence",
                             [](const Calibration& found) { return experiment::judgement_sentence(found); })
      .def_property_readonly("json",
                             [](const Calibration& found) { return experiment::to_json(found).dump(); });
  module.def("calibrate", &calibrate);
  module.def("dead_reckon", &dead_reckon);
}

}  // namespace astro::python
