#include "host/experiment/files/curvature_named.hpp"

#include <fmt/format.h>

#include <cmath>
#include <variant>

#include "host/base/error.hpp"

namespace astro::experiment {
namespace {

[[noreturn]] void fail_of_no_robot(const std::string& where, const std::string& name, double value) {
  const std::string number = fmt::format("{:.4g}", value);
  throw Error(fmt::format("{} has {} = {}, which no robot has: correct or replace it", where, name, number),
              CurvatureProblem::of_no_robot, {where, name, number});
}

}  // namespace

calibration::WheelFactors with_curvature(calibration::WheelFactors factors, std::optional<double> e,
                                         std::optional<double> kappa0, const std::string& where) {
  constexpr double kMostE = 0.5, kLeastKappa0 = 1e-3, kMostKappa0 = 100;  // far beyond any robot
  factors.e = e.value_or(0);
  factors.kappa0 = kappa0.value_or(calibration::kUsualKappa0);
  if (!(std::abs(factors.e) < kMostE)) fail_of_no_robot(where, "e", factors.e);
  if (!(factors.kappa0 >= kLeastKappa0 && factors.kappa0 <= kMostKappa0))
    fail_of_no_robot(where, "kappa0", factors.kappa0);
  return factors;
}

void require_no_text(const NamedValues& values, const std::string& name, const std::string& where) {
  const auto found = values.find(name);
  if (found == values.end()) return;
  if (const auto* text = std::get_if<std::string>(&found->second))
    throw Error(fmt::format("{} has {} = '{}', which is text and no number: correct or replace it", where,
                            name, *text),
                CurvatureProblem::is_text, {where, name, *text});
}

}  // namespace astro::experiment
