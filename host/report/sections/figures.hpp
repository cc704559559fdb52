#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "host/report/sections/groups.hpp"

/// The numbers behind the figures, as web/report.js reads them.
namespace astro::report {

/// {"phases": [title], "clusters": [...], "groups": [...]}. Units: mm and rad in clusters; in a run t in s,
/// the odometry path x, y in m, the errors ex, ey in mm and eh in rad (null where the tracker had lost the
/// robot), so the true path is odometry + error. Rounded to a tenth of what the ground truth resolves, 1500
/// points a run.
nlohmann::json figure_data(const std::vector<Phase>& phases, const std::vector<RunGroup>& groups);

}  // namespace astro::report
