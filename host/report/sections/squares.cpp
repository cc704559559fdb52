#include "host/report/sections/squares.hpp"

namespace astro::report {

bool has_squares(const Phase& phase) { return !phase.cw.empty() && !phase.ccw.empty(); }

std::vector<SquarePhase> square_phases(const ReportInput& input) {
  std::vector<SquarePhase> out;
  for (std::size_t i = 0; i < input.phases.size(); ++i) {
    if (has_squares(input.phases[i])) out.push_back({i, &input.phases[i]});
  }
  return out;
}

calibration::FigureOfMerit largest_error_mm(const Phase& phase) { return E_max_syst_mm(phase.squares); }

}  // namespace astro::report
