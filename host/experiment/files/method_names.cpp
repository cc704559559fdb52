#include "host/experiment/files/method_names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "host/base/error.hpp"

namespace astro::experiment {
namespace {

using calibration::AngleSource;
using calibration::Formula;
using calibration::Method;

template <class Enum>
Enum find(const std::string& word, const char* what, const std::vector<Enum>& values,
          const char* others = "") {
  std::vector<std::string> names;
  for (const Enum value : values) {
    names.emplace_back(name_of(value));
    if (names.back() == word) return value;
  }
  const std::string known = fmt::format("{}{}", others, fmt::join(names, ", "));
  throw Error(fmt::format("'{}' is no {}: there are {}", word, what, known), NameProblem::unknown,
              {word, what, known});
}

}  // namespace

MethodChoice method_named(const std::string& method, const std::string& angles, const std::string& formula) {
  using Family = MethodChoice::Family;
  MethodChoice choice;
  choice.family = method == kAutomaticName ? Family::automatic
                  : method == kMlName      ? Family::ml
                  : method == kScanName    ? Family::scans
                                           : Family::end_poses;
  if (choice.family == Family::end_poses)
    choice.options.method = find<Method>(
        method, "method", {Method::umbmark, Method::extended, Method::least_squares, Method::robust},
        "auto, ml, scan, ");
  choice.options.angles =
      find<AngleSource>(angles, "source of angles",
                        {AngleSource::x, AngleSource::y, AngleSource::thesis, AngleSource::average});
  choice.options.formula = find<Formula>(formula, "formula", {Formula::exact, Formula::published});
  return choice;
}

std::string_view name_of(const MethodChoice& method) {
  if (method.family == MethodChoice::Family::automatic) return kAutomaticName;
  if (method.family == MethodChoice::Family::ml) return kMlName;
  if (method.family == MethodChoice::Family::scans) return kScanName;
  return calibration::name_of(method.options.method);
}

std::string_view name_of(calibration::Motion motion) {
  switch (motion) {
    case calibration::Motion::rest:
      return "rest";
    case calibration::Motion::line:
      return "line";
    case calibration::Motion::arc:
      return "arc";
    default:
      return "spin";
  }
}

Order order_named(const std::string& order) {
  return find<Order>(order, "order of directions", {Order::alternating, Order::cw_first, Order::ccw_first});
}

}  // namespace astro::experiment
