#include "host/import/drives/drive_pair.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "host/base/error.hpp"
#include "host/import/drives/wheel_doubts.hpp"
#include "host/import/drives/wheel_run.hpp"
#include "host/truth/files/body_track.hpp"

namespace astro::importing {
namespace {

/// Times of wheels and tracker are as in their files: microseconds with any origin. If there are more than 40
/// minutes of samples at 100 Hz, several samples become one motion.
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

/// `exchanged`: a person said that the file has left and right exchanged.
void settle_direction(const std::string& name, const recording::Run& run, bool exchanged,
                      const truth::FloorFindings& findings, std::vector<Remark>& remarks) {
  constexpr double kClear_m = 0.03;  // more than the usual height of a tracker's origin above its floor
  const std::string distance = fmt::format("{:.2f}", -findings.height_m);
  const auto kind = [&](ImportProblem problem) {
    return exchanged ? ImportProblem::turns_against_exchanged : problem;
  };
  // If the axis points down and the wheels are exchanged, both turn alike.
  if (!findings.turns_against_wheels && !findings.up_given && findings.height_m < -kClear_m)
    throw Error(
        fmt::format(
            "the body is {} m below the tracker's origin, so the axis that seems to point up may point down "
            "and the wheels may {}be exchanged",
            distance, exchanged ? "not " : ""),
        kind(ImportProblem::below_origin), {name, distance});
  if (!findings.turns_against_wheels) return;
  const std::string fact = "the wheels turn the robot the other way than the ground truth";
  if (!exchanged && findings.height_m <= kClear_m && drove_backward(run))
    throw Error(fact + ", and they count backward, so both encoders seem to be reversed",
                ImportProblem::encoders_reversed, {name});
  if (findings.up_given) throw Error(fact, kind(ImportProblem::turns_against_stated_up), {name});
  if (findings.height_m > kClear_m) {
    remarks.push_back({"the wheels show that the tracker's axis that seems to point up points down"});
    return;
  }
  if (findings.height_m < -kClear_m)
    throw Error(fmt::format("{}, and the body is {} m above the tracker's origin", fact, distance),
                kind(ImportProblem::turns_against_wheels), {name, distance});
  throw Error(fact + ", and nothing shows which of the two is a mirror image",
              kind(ImportProblem::turns_against_wheels), {name});
}

std::string summary_of(const ImportedTruth& truth, const truth::FloorFindings& floor) {
  const std::string text =
      fmt::format("; {} poses{} ({}) at {:.4g} Hz, {} lost", truth.track.samples.size(),
                  truth.track.name.empty() ? "" : " of '" + truth.track.name + "'", truth.track.facts.format,
                  rate_hz(truth.track.samples), truth.lost.all());
  return truth.track.facts.flat ? text : text + "; " + truth::axis_text(floor.up) + " is up";
}

/// The unit of time that was assumed, or "".
std::string assumed_in(const std::vector<Remark>& remarks) {
  for (const Remark& remark : remarks)
    if (remark.kind == WheelRemark::time_unit_assumed || remark.kind == truth::TrackRemark::time_unit_assumed)
      return remark.values.at(0);
  return "";
}

/// Wheels that were worked out from a robot's odometry fit it perfectly.
void refuse_own_odometry(const DriveFiles& files, const std::string& topic, const ImportedTruth& truth) {
  const std::string& id = truth.track.id;
  if (topic.empty() || files.wheels != files.truth || (id != topic && !id.starts_with(topic + ' '))) return;
  throw Error(files.wheels.string() +
                  ": both the wheels and the ground truth would be the robot's own odometry " + topic,
              ImportProblem::odometry_is_truth, {topic});
}

}  // namespace

PairedDrive pair_up(const std::string& name, const DriveFiles& files, ImportedWheels wheels,
                    const ImportedTruth& truth, const RobotGeometry& given, const ImportChoices& choices) {
  const AssumedTimeUnit wheel_times{files.wheels.string(), assumed_in(wheels.track.remarks)},
      truth_times{files.truth.string(), assumed_in(truth.track.facts.remarks)};
  const std::optional<double> counter_range = wheels.track.counter_range;
  WheelRun made = run_of_wheels(name, std::move(wheels), given, choices.wheels.imu_axis);
  PairedDrive drive{
      std::move(made.run), {{}, std::move(made.summary), std::move(made.remarks)}, counter_range};
  drive.run.info.truth_source = "file";
  drive.run.info.truth_clock = "tracker";
  std::vector<Remark>& all = drive.report.remarks;
  truth::FloorPath floor = truth::place_on_floor(truth.track, motion_of(drive.run.odometry), choices.floor);
  const bool converted = floor.findings.length_factor != 1;
  for (const Remark& remark : truth.track.facts.remarks)
    if (!converted || remark.kind != Kind(truth::TrackRemark::length_unit_assumed)) all.push_back(remark);
  drive.run.truth = std::move(floor.samples);
  drive.report.floor = std::move(floor.findings);
  all.insert(all.end(), drive.report.floor.remarks.begin(), drive.report.floor.remarks.end());
  require_turning_wheels(name, drive.run, drive.report.floor);
  require_times_alike(drive.run, drive.report.floor, wheel_times, truth_times);
  settle_direction(name, drive.run, choices.wheels.exchanged, drive.report.floor, all);
  drive.report.summary += summary_of(truth, drive.report.floor);
  return drive;
}

PairedDrive paired(const std::string& name, const DriveFiles& files, const ImportChoices& choices,
                   RecordedSizes& geometry) {
  ImportedWheels wheels = read_wheels(files.wheels, choices.wheels);
  const RobotGeometry& sizes = geometry.of(files.wheels, wheels);
  const ImportedTruth truth = read_truth(files.truth, choices.truth);
  refuse_own_odometry(files, wheels.track.odometry, truth);
  try {
    return pair_up(name, files, std::move(wheels), truth, sizes, choices);
  } catch (const Error& error) {
    throw Error(error.in("'" + files.wheels.string() + "' with '" + files.truth.string() + "': "));
  }
}

}  // namespace astro::importing
