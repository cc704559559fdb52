#include "host/report/sections/history.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "host/report/page/html.hpp"
#include "host/report/page/numbers.hpp"
#include "host/report/sections/squares.hpp"

namespace astro::report {

using calibration::FigureOfMerit;

namespace {

std::string cell(const LoadedValue& value) {
  return "<td>" + with_error(value.value, value.standard_error, six_digits(value.value)) + "</td>";
}

std::string phase_row(const Phase& phase) {
  std::string row = "<tr><th scope=\"row\">" + escape(capitalised(phase.title)) + "</th>";
  for (const LoadedValue& value : phase.loaded) row += cell(value);
  if (!has_squares(phase)) return row + "<td>–</td></tr>\n";
  const FigureOfMerit error = largest_error_mm(phase);
  return row + "<td>" + with_error(error.value, error.standard_error, 1) + "</td></tr>\n";
}

}  // namespace

Section history(const ReportInput& input) {
  Section out{"history", "History", ""};
  const bool complete = std::all_of(input.phases.begin(), input.phases.end(), [&](const Phase& phase) {
    return !phase.loaded.empty() && phase.loaded.size() == input.parameters.size();
  });
  if (input.phases.size() < 3 || !complete) return out;
  std::string head, rows;
  for (const ParameterRow& p : input.parameters)
    head += "<th scope=\"col\">" + escape(p.name) +
            (p.unit.empty() ? "" : R"( <span class="unit">)" + escape(p.unit) + "</span>") + "</th>";
  for (const Phase& phase : input.phases) rows += phase_row(phase);
  out.body = fmt::format(
      R"(<div class="scroll"><table class="wide"><caption>What was loaded in the robot in each phase, with the standard errors of the calibration that found it, and what was left of the square’s error.</caption>
<thead><tr><th scope="col">Phase</th>{}<th scope="col"><var>E</var><sub>max,syst</sub> <span class="unit">mm</span></th></tr></thead><tbody>{}</tbody></table></div>)",
      head, rows);
  return out;
}

}  // namespace astro::report
