#pragma once

#include <string>
#include <vector>

#include "host/console/command_line.hpp"
#include "host/experiment/files/plan.hpp"

/// --method, --angles and --formula: how a calibration finds the factors.
namespace astro::commands {

struct MethodOption {
  std::string method = "auto", angles = "average", formula = "exact";
  console::Option angles_option, formula_option;

  /// Throws console::WrongUsage for a variant of another method than the chosen one, because it would have no effect.
  experiment::MethodChoice choice() const;
};

/// `methods`: the valid names; `what`: the help of --method.
void add_method(console::Command command, MethodOption& option, const std::vector<std::string>& methods,
                const std::string& what);

}  // namespace astro::commands
