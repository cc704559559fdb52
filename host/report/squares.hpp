#pragma once

#include <cstddef>
#include <vector>

#include "host/calibration/judgement/before_after.hpp"
#include "host/report/page.hpp"
#include "host/report/report.hpp"

/// The phases in which squares were driven in both directions, what is left of the square's error, and the sections that show it.
namespace astro::report {

/// True if both directions of the square were driven, which E_max_syst needs.
bool has_squares(const Phase& phase);

/// A phase with squares, and its index in the input.
struct SquarePhase {
  std::size_t index;
  const Phase* phase;
};
std::vector<SquarePhase> square_phases(const ReportInput& input);

/// E_max_syst of a phase in mm, with the number of runs of the direction that it comes from.
calibration::FigureOfMerit largest_error_mm(const Phase& phase);

/// The largest systematic error of the square in each phase, and the improvement in words.
Section headline(const ReportInput& input);

/// Where the squares ended: the clusters of end errors of each phase.
Section scatter(const ReportInput& input);

}  // namespace astro::report
