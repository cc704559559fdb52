#include "host/experiment/drive/programme_work.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/experiment/drive/record_run.hpp"
#include "host/experiment/files/experiment_folder.hpp"

namespace astro::experiment {
namespace {

constexpr double kStops_s = 1;  // each segment speeds up and slows down

double length_m(const protocol::AddSegment& segment) { return 1e-9 * static_cast<double>(segment.length_nm); }
double turn_rad(const protocol::AddSegment& segment) {
  return 2 * std::numbers::pi * std::ldexp(static_cast<double>(segment.angle), -32);
}

double driving_s(const Plan& plan, const RunSpec& spec) {
  double time_s = 0;
  for (const protocol::AddSegment& segment : path_of(plan, spec))
    time_s += std::max(std::abs(length_m(segment)) / plan.speed_mps,
                       std::abs(turn_rad(segment)) / plan.yaw_rate_radps) +
              kStops_s;
  return time_s;
}

/// How a robot deviates from what it is commanded.
struct Miss {
  double veers_radpm = 0;  // turns on a straight metre
  double turns = 1;        // real over commanded turn
};

/// A point that drives along segments and extends the field that it has covered.
class Walk {
 public:
  explicit Walk(const Miss& miss) : miss_(miss) {}

  void along(const protocol::AddSegment& segment, DrivenField& field) {
    constexpr int kSteps = 64;
    const double step_m = length_m(segment) / kSteps;
    const double step_rad = miss_.turns * turn_rad(segment) / kSteps + miss_.veers_radpm * step_m;
    for (int i = 0; i < kSteps; ++i) {
      const double middle_rad = heading_rad_ + step_rad / 2;
      x_m_ += step_m * std::cos(middle_rad);  // the arc's length for its chord's
      y_m_ += step_m * std::sin(middle_rad);
      heading_rad_ += step_rad;
      field = {std::min(field.from_ahead_m, x_m_), std::max(field.to_ahead_m, x_m_),
               std::min(field.from_left_m, y_m_), std::max(field.to_left_m, y_m_)};
    }
  }

 private:
  Miss miss_;
  double x_m_ = 0, y_m_ = 0, heading_rad_ = 0;
};

}  // namespace

ProgrammeWork work_of(const Plan& plan, const std::filesystem::path& folder) {
  ProgrammeWork work;
  for (std::size_t phase = 0; phase < phase_names(plan).size(); ++phase)
    for (const RunSpec& spec : runs_of_phase(plan, phase, plan.runs)) {
      ++work.all;
      if (std::filesystem::exists(file_of(folder, spec))) continue;
      ++work.left;
      work.driving_s += driving_s(plan, spec);
    }
  return work;
}

DrivenField field_of(const Plan& plan, double wheelbase_m) {
  constexpr double kWheels = 0.005, kWheelbase = 0.01;
  DrivenField field;
  for (const double wheels : {-kWheels, 0.0, kWheels})
    for (const double base : {-kWheelbase, 0.0, kWheelbase}) {
      Walk walk({wheels / wheelbase_m, 1 + base});
      for (const RunSpec& spec : runs_of_phase(plan, 0, plan.runs))
        for (const protocol::AddSegment& segment : path_of(plan, spec)) walk.along(segment, field);
    }
  return field;
}

}  // namespace astro::experiment
