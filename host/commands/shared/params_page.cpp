#include "host/commands/shared/params_page.hpp"

#include <fmt/format.h>

#include "common/params/table.hpp"
#include "host/commands/shared/params_view.hpp"
#include "host/console/help.hpp"

namespace astro::commands {

std::string parameters_page() {
  std::string page =
      "# Every parameter of the robot\n\n"
      "`astrolabe params list` shows those of a robot with their values, and\n"
      "`astrolabe params set NAME=VALUE` sets one. A calibration loads c_R, c_L, b\n"
      "and e, `astrolabe tune` the gains, `astrolabe check-wiring` the polarities.\n\n";
  for (const ParamRow& own : kParamTable) {
    robot::ParameterRow row;
    row.unit = own.unit;
    row.doc = own.doc;
    row.kind = static_cast<protocol::ParameterKind>(own.kind);  // the numbers are the same
    row.exponent = own.exponent;
    row.minimum = own.minimum_raw;
    row.maximum = own.maximum_raw;
    row.default_value = own.default_raw;
    page += console::wrapped(fmt::format("- `{}`: {}", own.name, explanation(row)), 0, 2) + '\n';
  }
  return page;
}

}  // namespace astro::commands
