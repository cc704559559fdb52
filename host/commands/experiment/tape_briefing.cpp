#include "host/commands/experiment/tape_briefing.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "host/base/text/columns.hpp"
#include "host/console/console.hpp"
#include "host/experiment/drive/record_run.hpp"
#include "host/experiment/files/experiment_folder.hpp"

namespace astro::commands {
namespace {

constexpr double kMeasuring_s = 120;  // three readings, and carrying the robot back to its mark
constexpr double kStops_s = 1;        // each segment speeds up and slows down

constexpr const char* kDrawing = R"(
        x, ahead                      heading, counter-clockwise is +
           ^
           |    o end                       o front mark on the chassis
           |    :                          /
           |    : x = +                   /   distance of the marks: M
           |    :                        o rear mark
 y, left <-+----'  y = -
           |       (right of the      The front mark is h further left of the
     [=]---+---[=]  line)             line than the rear mark: type h/M, such
       start mark                     as 18/300, or the angle.

Mark the floor under the middle of the axle, and draw a line ahead from there,
where the robot points: each run has to begin exactly so. After a run measure to
the floor under the middle of the axle: x along the line, y across it.
)";

double driving_s(const experiment::Plan& plan, const experiment::RunSpec& spec) {
  double time_s = 0;
  for (const protocol::AddSegment& segment : experiment::path_of(plan, spec)) {
    const double turned_rad =
        2 * std::numbers::pi * std::ldexp(std::abs(static_cast<double>(segment.angle)), -32);
    const double length_m = std::abs(static_cast<double>(segment.length_nm)) * 1e-9;
    time_s += std::max(length_m / plan.speed_mps, turned_rad / plan.yaw_rate_radps) + kStops_s;
  }
  return time_s;
}

struct Work {
  int all = 0, left = 0;  // runs
  double driving_s = 0;   // of those that are left

  double minutes() const { return (driving_s + left * kMeasuring_s) / 60; }
};

Work work_of(const experiment::Plan& plan, const std::filesystem::path& folder) {
  Work work;
  for (std::size_t phase = 0; phase < experiment::phase_names(plan).size(); ++phase)
    for (const experiment::RunSpec& spec : experiment::runs_of_phase(plan, phase, plan.runs)) {
      ++work.all;
      if (std::filesystem::exists(experiment::file_of(folder, spec))) continue;
      ++work.left;
      work.driving_s += driving_s(plan, spec);
    }
  return work;
}

/// "before: 5 + 5 squares and 3 lines"
std::string phase_text(const experiment::Plan& plan, std::size_t phase) {
  const int squares = 2 * plan.runs;
  const auto runs = experiment::runs_of_phase(plan, phase, plan.runs);
  const int lines = static_cast<int>(runs.size()) - squares;
  std::string text =
      fmt::format("{}: {} + {} squares", experiment::phase_names(plan)[phase], plan.runs, plan.runs);
  if (lines > 0) text += fmt::format(" and {} lines", lines);
  return text;
}

}  // namespace

std::string tape_briefing(const experiment::Plan& plan, const std::filesystem::path& folder) {
  const Work work = work_of(plan, folder);
  std::string phases;
  for (std::size_t i = 0; i < experiment::phase_names(plan).size(); ++i)
    phases += (i == 0 ? "" : "; ") + phase_text(plan, i);
  const std::string text = fmt::format(
      "{} of {} runs are to be driven ({}). Each has three readings: x, y and, if you can, the heading; that "
      "makes {} "
      "readings. It takes about {:.0f} minutes: {:.0f} of driving, and 2 for each run to measure and to "
      "carry the robot back.",
      work.left, work.all, phases, 3 * work.left, work.minutes(), work.driving_s / 60);
  return wrapped(text) + kDrawing;
}

}  // namespace astro::commands
