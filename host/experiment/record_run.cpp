#include "host/experiment/record_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <utility>

#include "host/base/error.hpp"

namespace astro::experiment {
namespace {

using namespace std::chrono_literals;
using protocol::Telemetry;

constexpr auto kRest = 700ms;  // at each end; host/recording/rest.hpp wants more than 200 ms
constexpr std::uint32_t kFields = Telemetry::kPose | Telemetry::kCounts | Telemetry::kTwist;
constexpr int kSamplesPerLook = 5;  // at the truth

constexpr link::Sense sense_of(recording::Direction direction) {
  return direction == recording::Direction::cw ? link::Sense::cw : link::Sense::ccw;
}

/// Collects both streams for as long as it lives.
class Collector {
 public:
  using Moved = std::function<void(const recording::OdometrySample&)>;

  Collector(
      link::Client& client, truth::Source& truth, recording::Run& run, Moved moved = [](const auto&) {})
      : client_(client),
        truth_(truth),
        run_(run),
        moved_(std::move(moved)),
        subscription_(client.on<Telemetry>([this](const Telemetry& telemetry) {
          run_.odometry.push_back(to_sample(telemetry));
          moved_(run_.odometry.back());
          if (run_.odometry.size() % kSamplesPerLook == 0) look();
        })) {
    truth_.poll();  // what was seen before is not of this run
    client_.request(protocol::SetTelemetry{kTelemetryPeriod_ms, kFields});
  }

  /// Records for so long, or until `interrupted`, by the robot's clock: a simulator in fast motion would
  /// stand for minutes in a second of ours.
  void stand(std::chrono::microseconds duration, const std::function<bool()>& interrupted) {
    const std::size_t first = run_.odometry.size();
    const auto done = [&] {
      return interrupted() ||
             (run_.odometry.size() > first &&
              run_.odometry.back().time_us - run_.odometry[first].time_us >= duration.count());
    };
    if (!client_.pump_until(done, 10 * duration))
      throw Error("the robot's telemetry has dried up while it stood: is the link good?");
  }

  /// Stops the stream. The truth may arrive a little later than the robot's word: waits until it is there.
  void finish() {
    client_.request(protocol::SetTelemetry{0, 0});
    look();
    for (int i = 0; i < 20 && !run_.truth.empty() && run_.truth.back().time_us + 100'000 < end_us(); ++i) {
      client_.pump(20ms);
      look();
    }
    std::erase_if(run_.truth, [&](const auto& sample) {
      return run_.odometry.empty() || sample.time_us < run_.odometry.front().time_us ||
             sample.time_us > end_us();
    });
  }

 private:
  void look() {
    for (const recording::TruthSample& sample : truth_.poll()) run_.truth.push_back(sample);
  }
  std::int64_t end_us() const { return run_.odometry.empty() ? 0 : run_.odometry.back().time_us; }

  link::Client& client_;
  truth::Source& truth_;
  recording::Run& run_;
  Moved moved_;
  link::Subscription subscription_;
};

}  // namespace

recording::OdometrySample to_sample(const Telemetry& telemetry) {
  constexpr double kMetre = 0x1p-40;
  constexpr double kTurn = 0x1p-64;
  recording::OdometrySample sample;
  sample.time_us = static_cast<std::int64_t>(telemetry.device_time_us);
  sample.x_m = static_cast<double>(telemetry.pose.x) * kMetre;
  sample.y_m = static_cast<double>(telemetry.pose.y) * kMetre;
  sample.theta_rad =
      2 * std::numbers::pi * (telemetry.pose.turns + static_cast<double>(telemetry.pose.theta) * kTurn);
  sample.v_mps = telemetry.twist.v_umps * 1e-6;
  sample.omega_radps = telemetry.twist.omega_uradps * 1e-6;
  sample.left_counts = telemetry.counts.left;
  sample.right_counts = telemetry.counts.right;
  return sample;
}

link::Path path_of(const Plan& plan, const RunSpec& spec) {
  const link::PathLimits limits{plan.speed_mps, plan.yaw_rate_radps};
  if (spec.kind == "square") return link::square(plan.side_m, sense_of(spec.direction), limits);
  if (spec.kind == "circle") return link::circle(plan.circle_radius_m, 1, sense_of(spec.direction), limits);
  return link::line(plan.line_m, limits);
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

recording::Run record_run(link::Client& client, truth::Source& truth, const link::Path& path,
                          const recording::RunInfo& info, const RunHooks& hooks) {
  recording::Run run;
  run.info = info;
  run.info.truth_source = truth.name();
  run.info.truth_clock = truth.clock();
  link::DriveHooks drive_hooks;
  drive_hooks.interrupted = hooks.interrupted;
  drive_hooks.notice = hooks.notice;
  drive_hooks.segment_done = [&](const protocol::SegmentDone& done) { hooks.segment_done(done.tag); };

  link::DriveSession drive(client, drive_hooks);
  client.request(protocol::SetPose{});
  Collector collector(client, truth, run, hooks.moved);
  const auto stand = [&] {
    collector.stand(kRest, hooks.interrupted);
    drive.pump(0us);  // throws if it was interrupted, or if the robot found a fault
  };
  stand();
  drive.run(path);
  stand();
  collector.finish();
  return run;
}

void complete(recording::Run& run, truth::Source& truth) {
  const std::vector<recording::TruthSample> samples = truth.complete(run);
  run.truth.insert(run.truth.end(), samples.begin(), samples.end());
}

recording::Run record_until(link::Client& client, truth::Source& truth, const recording::RunInfo& info,
                            const std::function<bool()>& done) {
  recording::Run run;
  run.info = info;
  run.info.truth_source = truth.name();
  run.info.truth_clock = truth.clock();
  Collector collector(client, truth, run);
  try {
    while (!client.pump_until(done, 50ms)) {
    }
    collector.finish();
  } catch (const Error& error) {
    if (run.odometry.empty()) throw;
    run.warning = error.what();
  }
  return run;
}

}  // namespace astro::experiment
