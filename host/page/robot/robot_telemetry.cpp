#include "host/page/robot/robot_telemetry.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "host/base/error.hpp"
#include "host/experiment/drive/record_run.hpp"
#include "host/page/calls/question.hpp"
#include "host/page/robot/robot_call_problem.hpp"
#include "host/recording/telemetry_sample.hpp"

namespace astro::page {
namespace {

using nlohmann::json;
using protocol::Telemetry;

constexpr std::uint16_t kUsualPeriod_ms = 20;
/// What pose, state and path events are made of.
constexpr std::uint32_t kAlways = Telemetry::kPose | Telemetry::kTwist | Telemetry::kCounts |
                                  Telemetry::kWheelSpeed | Telemetry::kBattery | Telemetry::kState |
                                  Telemetry::kPath;

json pose_json(const Pose2& pose) {
  return {{"x_m", pose.x_m}, {"y_m", pose.y_m}, {"heading_rad", pose.theta_rad}};
}

}  // namespace

json RobotTelemetry::watch(OpenedRobot& robot, Page page, const json& question) {
  std::vector<const Signal*> wanted;
  for (const std::string& name : texts_in(question, "signals")) wanted.push_back(&signal_named(name));
  const double rate_hz = number_in(question, "rate_hz", 1, 1000).value_or(50);
  const auto period_ms = static_cast<std::uint16_t>(std::lround(1000 / rate_hz));
  if (live::RobotSession* found = robot.session()) take_from(robot, *found);  // of the time before
  watches_.erase(page);
  if (!wanted.empty()) watches_.emplace(page, SignalWatch(std::move(wanted), period_ms));
  ask(&robot);
  return {{"rate_hz", 1000.0 / period_ms}};
}

json RobotTelemetry::begin_recording(OpenedRobot& robot) {
  live::RobotSession& found = robot.required_session();
  recording::RunInfo info = experiment::info_of(found.client().robot(), found.numbers());
  robot.take_truth();  // that of before is not recorded
  if (robot.is_simulated()) info.truth_source = "sim", info.truth_clock = "robot";
  recordings_.begin(info);
  ask(&robot);
  return {{"file", recordings_.file()}};
}

json RobotTelemetry::end_recording(OpenedRobot* robot) {
  if (!recordings_.under_way()) throw Error("no recording is under way");
  const std::string file = recordings_.end();
  ask(robot);
  return {{"file", file}};
}

void RobotTelemetry::require_no_recording() const {
  if (recordings_.under_way())
    throw Error("a recording is under way: end it first", {}, {recordings_.file()});
}

void RobotTelemetry::ask(OpenedRobot* robot) {
  protocol::SetTelemetry wanted{kUsualPeriod_ms, kAlways};
  for (const auto& [page, each] : watches_) {
    wanted.period_ms = std::min(wanted.period_ms, each.period_ms());
    wanted.fields |= each.fields();
  }
  if (recordings_.under_way()) wanted.fields = Telemetry::kAll;
  period_ms_ = wanted.period_ms;
  if (robot != nullptr) robot->link().ask_for_telemetry(wanted);
}

void RobotTelemetry::take_from(OpenedRobot& robot, live::RobotSession& session) {
  while (const auto sample = session.take_sample()) take(robot, *sample);
}

void RobotTelemetry::take(OpenedRobot& robot, const Telemetry& telemetry) {
  newest_ = telemetry;
  if (recordings_.under_way()) recordings_.add(telemetry, robot.take_truth());
  for (auto& [page, each] : watches_) each.take(telemetry, period_ms_);
}

/// The robot drives on, whatever becomes of its recording.
std::optional<std::string> RobotTelemetry::end_full_recording(OpenedRobot& robot) {
  if (!recordings_.full()) return std::nullopt;
  std::string sentence =
      "the recording has taken all the room that there is for recordings, and has ended: save it";
  try {
    recordings_.end();
  } catch (const Error& error) {
    sentence = error.what();
  }
  ask(&robot);
  return sentence;
}

void RobotTelemetry::forget_robot() {
  newest_.reset();
  watches_.clear();
}

void RobotTelemetry::report(const OpenedRobot& robot, const std::function<void(Page, const json&)>& tell) {
  for (auto& [page, each] : watches_) {
    const auto samples = each.batch(robot.now());
    if (!samples) continue;
    tell(page, *samples);
    const recording::OdometrySample at = recording::to_sample(*newest_);
    json pose = pose_json({at.x_m, at.y_m, at.theta_rad});
    const auto truth = robot.truth();
    pose.update({{"event", "pose"}, {"truth", truth ? pose_json(*truth) : json(nullptr)}});
    tell(page, pose);
  }
}

}  // namespace astro::page
