#include "host/simulation/study/programme.hpp"

#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "host/base/error.hpp"
#include "host/base/text/sense.hpp"
#include "host/simulation/study/limits.hpp"
#include "host/simulation/study/synthetic_drive.hpp"

namespace astro::simulation::study {
namespace {

using calibration::Trajectory;

std::string plain(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

void require_sizes(const Programme& programme) {
  require_positive(programme.side_m, "the side of the squares in metres");
  require_positive(programme.line_m, "the length of the lines in metres");
  require_positive(programme.turns, "the number of turns of a spin");
  require_positive(programme.radius_m, "the radius of the circles in metres");
  require_positive(programme.wheelbase_m, "the wheelbase in metres");
  require_positive(programme.noise.K_m, "the wheel slip K in metres");
  require_positive(programme.noise.sigma_xy_m, "the error of the ground truth's position in metres");
  require_positive(programme.noise.sigma_theta_rad, "the error of the ground truth's heading in radians");
  require_positive(programme.truth_rate_hz, "the rate of the ground truth in Hz");
  require_positive(programme.count_rate_hz, "the rate of the counts in Hz");
  require_positive(programme.speed_mps, "the speed in m/s");
  require_positive(programme.yaw_rate_radps, "the yaw rate in rad/s");
}

int total(const Counts& counts) { return std::accumulate(counts.begin(), counts.end(), 0); }

void require_runs(const Counts& counts) {
  for (std::size_t kind = 0; kind < kKinds; ++kind)
    if (counts[kind] < 0 || counts[kind] > kMostRuns)
      throw Error("the number of " + std::string(kKindNames[kind]) + " is " + std::to_string(counts[kind]) +
                      ": it has to be 0 to " + std::to_string(kMostRuns),
                  LimitProblem::out_of_range,
                  {"the number of " + std::string(kKindNames[kind]), std::to_string(counts[kind])});
  if (const int runs = total(counts); runs > kMostRuns)
    throw Error("the programme has " + std::to_string(runs) + " runs and " + std::to_string(kMostRuns) +
                    " are the most: drive longer ones",
                ProgrammeProblem::too_many_runs, {std::to_string(runs)});
  if (const auto why = why_undetermined(counts)) throw Error(*why);
}

Course course_of(const Programme& programme, std::size_t kind, Sense sense) {
  const double sign = sign_of(sense), turn = sign * 2 * std::numbers::pi;
  switch (kind) {
    case kSquares:
      return square_course(programme.side_m, sense);
    case kLines:
      return line_course(programme.line_m);
    case kSpins:
      return spin_course(turn * programme.turns);
    default:
      return circle_course(programme.radius_m, turn);
  }
}

/// Calls use(course, name of such a run, number of runs) for each kind and direction, cw before ccw.
template <class Use>
void for_each_course(const Programme& programme, Use use) {
  for (std::size_t kind = 0; kind < kKinds; ++kind)
    for (const Sense sense : {Sense::cw, Sense::ccw}) {
      const int both = programme.counts[kind];
      const int times = sense == Sense::cw ? (both + 1) / 2 : both / 2;
      const std::string_view plural = kKindNames[kind];
      if (times > 0)
        use(course_of(programme, kind, sense), std::string(plural.substr(0, plural.size() - 1)), times);
    }
}

calibration::DriveExtent extent_of(const Programme& programme) {
  calibration::DriveExtent extent;
  for_each_course(programme, [&](const Course& course, const std::string&, int times) {
    for (const Leg& leg : course) {
      extent.distance_m += times * std::abs(leg.length_m);
      extent.rotation_rad += times * std::abs(leg.angle_rad);
    }
  });
  return extent;
}

DriveModel model_of(const Programme& programme) {
  DriveModel model;
  model.loaded = model.actual = {1, 1, programme.wheelbase_m};
  model.noise = {0, 0, 0};
  model.count_rate_hz = programme.count_rate_hz;
  model.truth_rate_hz = programme.truth_rate_hz;
  model.speed_mps = programme.speed_mps;
  model.yaw_rate_radps = programme.yaw_rate_radps;
  return model;
}

}  // namespace

std::optional<Remark> why_undetermined(const Counts& counts) {
  const int runs = total(counts);
  if (runs == 0)
    return Remark{"the programme is empty: say how many squares, lines, spins or circles",
                  ProgrammeProblem::no_runs};
  if (counts[kLines] == runs)
    return Remark{"lines never turn, so they do not determine the wheelbase: add squares, spins or circles",
                  ProgrammeProblem::lines_alone};
  if (counts[kSpins] == runs)
    return Remark{
        "spins determine the ratio of wheels and wheelbase but no size: add squares, lines or circles",
        ProgrammeProblem::spins_alone};
  if (counts[kCircles] == 1 && runs == 1)
    return Remark{
        "one circle turns in one direction only, which does not separate wheels and wheelbase: drive two",
        ProgrammeProblem::one_circle};
  return std::nullopt;
}

std::optional<std::string> why_e_is_hidden(const Counts& counts) {
  if (counts[kCircles] == 0) return "runs without circles hardly show e";
  if (counts[kSquares] + counts[kSpins] == 0)
    return "runs without squares and spins hardly tell e from the wheelbase";
  return std::nullopt;
}

Programme Programme::with(const Counts& other) const {
  Programme programme = *this;
  programme.counts = other;
  return programme;
}

std::string Programme::text() const {
  const std::array<std::string, kKinds> sizes = {"of " + plain(side_m) + " m", "of " + plain(line_m) + " m",
                                                 "of " + plain(turns) + " turns",
                                                 "of radius " + plain(radius_m) + " m"};
  std::string text;
  for (std::size_t kind = 0; kind < kKinds; ++kind) {
    if (counts[kind] == 0) continue;
    std::string name(kKindNames[kind]);
    if (counts[kind] == 1) name.pop_back();
    text += (text.empty() ? "" : ", ") + std::to_string(counts[kind]) + " " + name + " " + sizes[kind];
  }
  return text;
}

Forecast forecast(const Programme& programme) {
  require_sizes(programme);
  require_runs(programme.counts);
  Forecast result;
  result.programme = programme;
  result.extent = extent_of(programme);
  require_fits_memory(
      result.extent.distance_m / programme.speed_mps + result.extent.rotation_rad / programme.yaw_rate_radps,
      programme.truth_rate_hz, programme.count_rate_hz);
  const DriveModel model = model_of(programme);
  std::vector<Trajectory> runs;
  for_each_course(programme, [&](const Course& course, const std::string& name, int times) {
    runs.insert(runs.end(), static_cast<std::size_t>(times), synthetic_drive(course, model, name, 0));
    result.driving_time_s += times * runs.back().wheels.back().time_s;
  });
  calibration::MlOptions options;
  options.noise = programme.noise;
  calibration::WheelFactors factors = model.actual;
  // Not zero, so that e counts as unknown, as in the estimate. So small a value does not change the information about it.
  factors.e = 1e-9;
  result.covariance = cramer_rao_bound(runs, factors, {}, options);
  result.se = errors_of(result.covariance, model.actual);
  return result;
}

}  // namespace astro::simulation::study
