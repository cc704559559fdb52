#include "host/commands/shared/method_option.hpp"

#include <fmt/format.h>

#include "host/console/wrong_usage.hpp"
#include "host/experiment/files/method_names.hpp"

namespace astro::commands {
namespace {

void require_method(const MethodOption& given, console::Option variant, const char* name,
                    const char* method) {
  if (variant.count() == 0 || given.method == method) return;
  throw console::WrongUsage(
      fmt::format("{0} is of --method {1}, and this is --method {2}: leave {0} out or give --method {1}",
                  name, method, given.method));
}

}  // namespace

experiment::MethodChoice MethodOption::choice() const {
  require_method(*this, angles_option, "--angles", "umbmark");
  require_method(*this, formula_option, "--formula", "extended");
  return experiment::method_named(method, angles, formula);
}

void add_method(console::Command command, MethodOption& option, const std::vector<std::string>& methods,
                const std::string& what) {
  command.add_option("--method", option.method, what).one_of(methods).capture_default_str();
  option.angles_option =
      command.add_option("--angles", option.angles, "umbmark: which coordinates the angles come from")
          .one_of({"x", "y", "thesis", "average"})
          .capture_default_str();
  option.formula_option =
      command.add_option("--formula", option.formula, "extended: exact, or as published by Jung and Chung")
          .one_of({"exact", "published"})
          .capture_default_str();
}

}  // namespace astro::commands
