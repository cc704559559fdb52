#include "host/experiment/drive/record_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <exception>
#include <optional>
#include <utility>
#include <vector>

#include "host/base/error.hpp"
#include "host/base/utc.hpp"
#include "host/experiment/analysis/scanned_runs.hpp"
#include "host/experiment/files/robot_identity.hpp"
#include "host/recording/run_metadata.hpp"
#include "host/recording/slip_remark.hpp"
#include "host/recording/telemetry_sample.hpp"
#include "host/robot/client/handshake.hpp"

namespace astro::experiment {
namespace {

using namespace std::chrono_literals;
using protocol::Telemetry;

constexpr auto kRest = 700ms;  // at each end; host/recording/rest.hpp needs more than 200 ms
constexpr std::uint32_t kFields =
    Telemetry::kPose | Telemetry::kCounts | Telemetry::kTwist | Telemetry::kFused;
constexpr int kSamplesPerLook = 5;  // odometry samples between two polls of the truth

/// Puts ground truth that is on this computer's clock onto the robot's, by a clock offset that does not
/// change during a recording: a map that follows every round trip would distort time, which looks like a
/// motion. The calibration estimates the rest of the offset, and the skew.
class TruthTime {
 public:
  TruthTime(robot::Client& client, const truth::Source& truth)
      : client_(client), on_host_(truth.clock() == "host") {}

  /// Returns false as long as no round trip has shown the robot's clock.
  bool known() {
    if (on_host_ && !offset_us_) {
      const std::int64_t now_us = client_.now().count();
      if (const auto device_us = client_.clock().to_device(now_us)) offset_us_ = *device_us - now_us;
    }
    return !on_host_ || offset_us_;
  }
  std::int64_t on_robot_us(std::int64_t time_us) const { return time_us + offset_us_.value_or(0); }

 private:
  robot::Client& client_;
  bool on_host_;
  std::optional<std::int64_t> offset_us_;
};

/// Passes both streams on during its lifetime: the truth samples between the first and the newest odometry.
class Collector {
 public:
  using Moved = std::function<void(const recording::OdometrySample&)>;

  Collector(
      robot::Client& client, truth::Source& truth, const SampleSink& sink, Moved moved = [](const auto&) {})
      : client_(client),
        truth_(truth),
        truth_time_(client, truth),
        sink_(sink),
        moved_(std::move(moved)),
        subscription_(client.on<Telemetry>([this](const Telemetry& telemetry) {
          take(recording::to_sample(telemetry));
          if (const auto pose = gyro_poses_.next(telemetry); pose && pose->time_us >= *first_us_)
            sink_.gyro(*pose);
          if (++count_.odometry % kSamplesPerLook == 0) look();
        })),
        slips_(client.on<protocol::SlipFound>([this](const protocol::SlipFound& found) { take(found); })) {
    truth_.poll();  // discards samples from before this run
    truth_.take_scans();
    client_.request(protocol::SetTelemetry{kTelemetryPeriod_ms, kFields});
  }

  /// Records for `duration` on the robot's clock, or until `interrupted`. The robot's clock counts, because a
  /// simulator may run much faster than real time.
  void stand(std::chrono::microseconds duration, const std::function<bool()>& interrupted) {
    const std::size_t before = count_.odometry;
    stand_from_us_.reset();
    const auto done = [&] {
      if (count_.odometry > before && !stand_from_us_) stand_from_us_ = newest_us_;
      return interrupted() || (stand_from_us_ && newest_us_ - *stand_from_us_ >= duration.count());
    };
    if (!client_.pump_until(done, 10 * duration))
      throw Error("the robot sent no more telemetry while it stood still: is the link good?");
  }

  /// Stops the stream. Waits for the last truth samples and the last scan, which may arrive a little later than the odometry.
  void finish() {
    client_.request(protocol::SetTelemetry{0, 0});
    look();
    for (int i = 0; i < 20 && (lags(newest_truth_us_) || lags(newest_scan_us_)); ++i) {
      client_.pump(20ms);
      look();
    }
  }

  const Recorded& count() const { return count_; }

 private:
  void take(const recording::OdometrySample& sample) {
    if (!first_us_) first_us_ = sample.time_us;
    newest_us_ = sample.time_us;
    sink_.odometry(sample);
    moved_(sample);
  }
  void take(const protocol::SlipFound& found) {
    const recording::GyroSlip slip = recording::to_sample(found);
    if (!first_us_ || slip.time_us < *first_us_) return;
    sink_.slip(slip);
    ++count_.slips;
  }
  bool lags(const std::optional<std::int64_t>& newest_us) const {
    return newest_us && *newest_us + 100'000 < newest_us_;
  }
  void look() {
    std::vector<recording::TruthSample> samples = truth_.poll();
    std::vector<lidar::Scan> scans = truth_.take_scans();
    if (!truth_time_.known()) return;
    for (lidar::Scan& scan : scans) take(std::move(scan));
    pass_scans_on();
    for (recording::TruthSample& sample : samples) {
      sample.time_us = truth_time_.on_robot_us(sample.time_us);
      newest_truth_us_ = sample.time_us;
      early_.push_back(sample);
    }
    for (; first_us_ && !early_.empty() && early_.front().time_us <= newest_us_; early_.pop_front()) {
      if (early_.front().time_us < *first_us_) continue;
      sink_.truth(early_.front());
      ++count_.truth;
    }
  }
  void take(lidar::Scan scan) {
    constexpr double kMicrosPerSecond = 1e6;
    scan.time_ns += 1000 * truth_time_.on_robot_us(0);
    const double lasts_us =
        kMicrosPerSecond * scan.beam_interval_s * static_cast<double>(scan.ranges_m.size());
    newest_scan_us_ = scan.time_ns / 1000 + std::llround(lasts_us);
    early_scans_.push_back(std::move(scan));
  }
  void pass_scans_on() {
    for (; first_us_ && !early_scans_.empty() && early_scans_.front().time_ns <= 1000 * newest_us_;
         early_scans_.pop_front()) {
      if (early_scans_.front().time_ns < 1000 * *first_us_) continue;
      sink_.scan(early_scans_.front());
      ++count_.scans;
    }
  }

  robot::Client& client_;
  truth::Source& truth_;
  TruthTime truth_time_;
  const SampleSink& sink_;
  Moved moved_;
  Recorded count_;
  std::deque<recording::TruthSample> early_;  // truth later than the newest odometry
  std::deque<lidar::Scan> early_scans_;       // the same of scans
  std::optional<std::int64_t> first_us_, newest_truth_us_, newest_scan_us_, stand_from_us_;
  std::int64_t newest_us_ = 0;
  recording::RecordedGyroPoses gyro_poses_;
  robot::Subscription subscription_, slips_;
};

/// What the scans do not show is no reason to lose the drive.
void place_by_scans(recording::Run& run, const RunHooks& hooks) {
  try {
    give_truth_by_scans(run);
  } catch (const Error& error) {
    hooks.notice(error.remark());
  }
}

/// From rest to rest; the robot is disarmed at the end.
void drive_recorded(robot::Client& client, truth::Source& truth, const robot::Path& path,
                    const robot::DriveHooks& drive_hooks, const RunHooks& hooks, recording::Run& run) {
  robot::DriveSession drive(client, drive_hooks);
  client.request(protocol::SetPose{});
  const SampleSink sink{[&](const auto& sample) { run.odometry.push_back(sample); },
                        [&](const auto& sample) { run.truth.push_back(sample); },
                        [&](const auto& scan) { run.scans.push_back(scan); },
                        [&](const auto& slip) { run.slips.push_back(slip); },
                        [&](const auto& pose) { run.gyro.push_back(pose); }};
  Collector collector(client, truth, sink, hooks.moved);
  const auto stand = [&] {
    collector.stand(kRest, hooks.interrupted);
    drive.pump(0us);  // throws if it was interrupted, or if the robot found a fault
  };
  stand();
  drive.run(path);
  stand();
  collector.finish();
}

}  // namespace

robot::Path path_of(const Plan& plan, const RunSpec& spec) {
  const robot::PathLimits limits{plan.speed_mps, plan.yaw_rate_radps};
  if (spec.kind == "square") return robot::square(plan.side_m, spec.direction.value(), limits);
  if (spec.kind == "circle")
    return robot::circle(plan.circle_radius_m, plan.circle_turns, spec.direction.value(), limits);
  return robot::line(plan.line_m, limits);
}

recording::RunInfo info_of(const Plan& plan, const RunSpec& spec) {
  recording::RunInfo info;
  info.kind = spec.kind;
  info.direction = spec.direction;
  info.phase = spec.phase;
  info.index = spec.index;
  info.size_m = spec.kind == "square"   ? plan.side_m
                : spec.kind == "circle" ? plan.circle_radius_m
                                        : plan.line_m;
  info.speed_mps = plan.speed_mps;
  return info;
}

recording::RunInfo info_of(const protocol::HelloReply& robot,
                           const std::map<std::string, double>& parameters) {
  const RobotIdentity identity = identity_of(robot);
  recording::RunInfo info;
  info.kind = "free";
  info.robot_name = identity.name;
  info.robot_id = identity.id;
  info.board = robot.board.view();
  info.firmware = robot::firmware_version(robot);
  info.started_at = utc_now();
  info.parameters = parameters;
  return info;
}

recording::Run record_run(robot::Client& client, truth::Source& truth, const robot::Path& path,
                          const recording::RunInfo& info, const RunHooks& hooks) {
  recording::Run run;
  run.info = info;
  run.info.truth_source = truth.name();
  run.info.truth_clock = truth.clock();
  robot::DriveHooks drive_hooks;
  drive_hooks.interrupted = hooks.interrupted;
  drive_hooks.resting = hooks.resting;
  drive_hooks.notice = hooks.notice;
  drive_hooks.segment_done = [&](const protocol::SegmentDone& done) { hooks.segment_done(done.tag); };

  truth.begin_run();
  drive_recorded(client, truth, path, drive_hooks, hooks, run);
  // The robot is disarmed by now: nobody would look after it while the scans are matched.
  if (!run.scans.empty()) place_by_scans(run, hooks);
  if (const auto slips = recording::slip_remark(run, recording::run_name(run.info))) hooks.notice(*slips);
  return run;
}

bool complete(recording::Run& run, truth::Source& truth) {
  const auto samples = truth.complete(run);
  if (samples) run.truth.insert(run.truth.end(), samples->begin(), samples->end());
  return samples.has_value();
}

Recorded record_until(robot::Client& client, truth::Source& truth, const SampleSink& sink,
                      const std::function<bool()>& done) {
  // An exception of the sink concerns the recording and must not be reported as a lost link.
  std::exception_ptr failure;
  const auto guarded = [&](const auto& take) {
    return [&failure, take](const auto& sample) {
      try {
        if (!failure) take(sample);
      } catch (...) {
        failure = std::current_exception();
      }
    };
  };
  const SampleSink guard{guarded(sink.odometry), guarded(sink.truth), guarded(sink.scan), guarded(sink.slip),
                         guarded(sink.gyro)};
  Collector collector(client, truth, guard);
  std::optional<Remark> warning;
  try {
    while (!client.pump_until([&] { return failure || done(); }, 50ms)) {
    }
    collector.finish();
  } catch (const Error& error) {
    if (!failure && collector.count().odometry == 0) throw;
    warning = error.remark();
  }
  if (failure) std::rethrow_exception(failure);
  Recorded recorded = collector.count();
  recorded.warning = warning;
  return recorded;
}

}  // namespace astro::experiment
