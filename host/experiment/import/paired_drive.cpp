#include "host/experiment/import/paired_drive.hpp"

#include <fmt/format.h>

#include <utility>

#include "host/base/error.hpp"
#include "host/experiment/import/wheel_run.hpp"

namespace astro::experiment {
namespace {

/// Times of wheels and tracker as they are in their files, so in microseconds of any origin. Several samples are one
/// motion if there are more than 40 minutes of them at 100 Hz.
std::vector<truth::WheelMotion> motion_of(const std::vector<recording::OdometrySample>& odometry) {
  constexpr std::size_t kMostMotions = 250'000;
  const std::size_t stride = odometry.size() / kMostMotions + 1;
  std::vector<truth::WheelMotion> motion;
  motion.reserve(odometry.size() / stride);
  for (std::size_t last = stride; last < odometry.size(); last += stride) {
    truth::WheelMotion sum{
        0.5e-6 * static_cast<double>(odometry[last - stride].time_us + odometry[last].time_us), 0, 0};
    double span_s = 0;
    for (std::size_t i = last - stride + 1; i <= last; ++i) {
      const double dt_s = 1e-6 * static_cast<double>(odometry[i].time_us - odometry[i - 1].time_us);
      sum.speed_mps += dt_s * odometry[i].v_mps;
      sum.yaw_rate_radps += dt_s * odometry[i].omega_radps;
      span_s += dt_s;
    }
    if (!(span_s > 0)) continue;  // within one microsecond
    motion.push_back({sum.time_s, sum.speed_mps / span_s, sum.yaw_rate_radps / span_s});
  }
  return motion;
}

void settle_direction(const std::string& name, const truth::FloorFindings& findings,
                      std::vector<Remark>& remarks) {
  constexpr double kClear_m = 0.03;  // more than a tracker's origin is off its floor
  // Exchanged wheels under an axis that points down turn as they should.
  if (!findings.turns_against_wheels && !findings.up_given && findings.height_m < -kClear_m)
    throw Error(
        fmt::format(
            "'{}': the body is {:.2f} m below the tracker's origin, so the axis that seems to point up "
            "may point down and the wheels may be exchanged",
            name, -findings.height_m),
        {Help::exchange_wheels_or_give_up});
  if (!findings.turns_against_wheels) return;
  const std::string fact = "'" + name + "': the wheels turn the robot the other way than the ground truth";
  if (findings.up_given) throw Error(fact, {Help::exchange_wheels_or_change_up});
  if (findings.height_m > kClear_m) {
    remarks.push_back({"the wheels show that the tracker's axis that seems to point up points down"});
    return;
  }
  if (findings.height_m < -kClear_m)
    throw Error(
        fmt::format("{}, and the body is {:.2f} m above the tracker's origin", fact, -findings.height_m),
        {Help::exchange_wheels_or_give_up});
  throw Error(fact + ", and nothing shows which of the two is a mirror image",
              {Help::exchange_wheels_or_give_up});
}

/// Samples in a second, from the first to the last.
template <class Sample>
double rate_hz(const std::vector<Sample>& samples) {
  const double span_s = 1e-9 * static_cast<double>(samples.back().time_ns - samples.front().time_ns);
  return span_s > 0 ? static_cast<double>(samples.size() - 1) / span_s : 0;
}

std::string summary_of(const ImportedTruth& truth, const truth::FloorFindings& floor) {
  return fmt::format("; {} poses{} ({}) at {:.4g} Hz, {} lost; {} is up", truth.track.samples.size(),
                     truth.track.name.empty() ? "" : " of '" + truth.track.name + "'",
                     truth.track.facts.format, rate_hz(truth.track.samples), truth.lost.all(),
                     truth::axis_text(floor.up));
}

}  // namespace

PairedDrive pair_up(const std::string& name, ImportedWheels wheels, const ImportedTruth& truth,
                    const RobotGeometry& given, const truth::FloorChoices& choices) {
  WheelRun made = run_of_wheels(name, std::move(wheels), given);
  PairedDrive drive{std::move(made.run), {{}, std::move(made.summary), std::move(made.remarks)}};
  drive.run.info.truth_source = "file";
  drive.run.info.truth_clock = "tracker";
  std::vector<Remark>& all = drive.report.remarks;
  const auto add = [&](const std::vector<Remark>& remarks) {
    all.insert(all.end(), remarks.begin(), remarks.end());
  };
  add(truth.track.facts.remarks);
  truth::FloorPath floor = truth::place_on_floor(truth.track, motion_of(drive.run.odometry), choices);
  drive.run.truth = std::move(floor.samples);
  drive.report.floor = std::move(floor.findings);
  add(drive.report.floor.remarks);
  settle_direction(name, drive.report.floor, all);
  drive.report.summary += summary_of(truth, drive.report.floor);
  return drive;
}

}  // namespace astro::experiment
