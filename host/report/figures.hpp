#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "host/base/pose2.hpp"
#include "host/recording/run.hpp"
#include "host/report/page.hpp"
#include "host/report/report.hpp"

/// The figures of the runs, and the numbers behind all figures of the page.
namespace astro::report {

/// The runs grouped for comparison: runs that were driven the same way, phase beside phase.
struct RunGroup {
  std::string title;                                       // "Squares of 3 m, clockwise"
  std::string kind;                                        // of recording::RunInfo
  std::vector<std::vector<const recording::Run*>> phases;  // one list per phase of the input, by run index
  std::size_t most_runs() const;
};

/// Squares first, then circles, lines and the rest; clockwise before counter-clockwise. Runs without an
/// odometry sample are left out. The pointers live as long as `phases`.
std::vector<RunGroup> group_runs(const std::vector<Phase>& phases);

/// To 1 / per_unit; null if it is no number.
nlohmann::json rounded(double value, double per_unit);

/// A point of a run for the figures: odometry and its error at the same time, in the run's start frame, time from its
/// first odometry sample. `error` is truth - odometry, NaN where the tracker had lost the robot.
struct SeriesPoint {
  double time_s = 0;
  Pose2 odometry, error;
};

/// recording::align_paths at the times of odometry: if the tracker is silent, the figure has a gap.
std::vector<SeriesPoint> series_of(const recording::Run& run);

/// At most `most` points (two or more), evenly spaced by index, the first and the last among them.
std::vector<SeriesPoint> thin(std::vector<SeriesPoint> points, std::size_t most);

/// For each group of comparable runs: paths by odometry and ground truth, and errors along the way.
Section run_figures(const ReportInput& input, const std::vector<RunGroup>& groups);

/// The numbers behind the figures, as web/report.js reads them:
/// {"phases": [title], "clusters": [...], "groups": [...]}. Units: mm and rad in clusters; in a run t in s,
/// the odometry path x, y in m, the errors ex, ey in mm and eh in rad (null where the tracker had lost the
/// robot), so the true path is odometry + error. Rounded to a tenth of what the ground truth resolves, 1500
/// points a run.
nlohmann::json figure_data(const std::vector<Phase>& phases, const std::vector<RunGroup>& groups);

}  // namespace astro::report
