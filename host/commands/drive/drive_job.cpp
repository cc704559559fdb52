#include "host/commands/drive/drive_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

#include "common/safety/wheel_stopped.hpp"
#include "host/commands/base/flags.hpp"
#include "host/commands/shared/drive_recording.hpp"
#include "host/commands/shared/limit_notes.hpp"
#include "host/commands/shared/path_progress.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/console/console.hpp"
#include "host/console/interrupt.hpp"
#include "host/console/options.hpp"
#include "host/experiment/drive/record_run.hpp"
#include "host/recording/telemetry_sample.hpp"

namespace astro::commands {
namespace {

using protocol::SetTelemetry;
using protocol::Telemetry;

constexpr microseconds kStep = std::chrono::milliseconds(50);  // from one velocity of Steering to the next
constexpr std::uint16_t kOdometryPeriod_ms = 20;               // Steering needs at most this period

/// Receives the robot's odometry for as long as the object lives, and keeps the newest sample.
class OdometryWatch {
 public:
  using Listener = std::function<void(const recording::OdometrySample&)>;

  static constexpr std::uint32_t kFields = Telemetry::kPose | Telemetry::kTwist;

  /// `listener` gets every sample; it must not call the client. `fields` must contain kPose.
  OdometryWatch(robot::Client& client, std::uint16_t period_ms, Listener listener, std::uint32_t fields)
      : client_(client),
        subscription_(client.on<Telemetry>([this, hear = std::move(listener)](const Telemetry& telemetry) {
          if ((telemetry.fields & Telemetry::kPose) == 0) return;
          newest_ = recording::to_sample(telemetry);
          hear(newest_);
        })) {
    client_.request(SetTelemetry{period_ms, fields});
  }
  ~OdometryWatch() {
    try {
      client_.request(SetTelemetry{0, 0});
    } catch (const std::exception&) {  // a lost robot sends no telemetry anyway
    }
  }
  OdometryWatch(const OdometryWatch&) = delete;
  OdometryWatch& operator=(const OdometryWatch&) = delete;

  /// Waits for a sample that the robot took after this call. Throws LinkLost if none comes.
  const recording::OdometrySample& fresh() {
    const auto now_us = static_cast<std::int64_t>(client_.request(protocol::Ping{}).device_time_us);
    if (!client_.pump_until([&] { return newest_.time_us > now_us; }, std::chrono::seconds(2)))
      throw robot::LinkLost(client_.name() + " sends no odometry although it was asked to");
    return newest_;
  }

 private:
  robot::Client& client_;
  recording::OdometrySample newest_;  // all zero before the first
  robot::Subscription subscription_;
};

/// How long the robot moved, by its own clock.
class Stopwatch {
 public:
  void moved_to(const recording::OdometrySample& sample) {
    // In a spin at kStill_radps, the wheels of the reference robot are half as fast as kStill_mps.
    constexpr double kStill_mps = 1e-6 * kWheelStopped_umps, kStill_radps = 0.01;
    if (std::abs(sample.v_mps) < kStill_mps && std::abs(sample.omega_radps) < kStill_radps) return;
    if (first_us_ == 0) first_us_ = sample.time_us;
    last_us_ = sample.time_us;
  }
  double seconds() const { return static_cast<double>(last_us_ - first_us_) / 1e6; }

 private:
  std::int64_t first_us_ = 0, last_us_ = 0;
};

void report(const DriveOptions& options, const char* outcome, const recording::OdometrySample& start,
            const recording::OdometrySample& end, double seconds) {
  const Pose2 moved = pose_of(start).between(pose_of(end));
  if (options.json)
    return print_json(Json{{"outcome", outcome},
                           {"duration_s", seconds},
                           {"moved", to_json(moved)},
                           {"odometry", to_json(pose_of(end))}});
  print(fmt::format("moved     {}   in {:.1f} s", in_words(moved), seconds));
  print(fmt::format("odometry  {}", in_words(pose_of(end))));
}

/// Shows a progress bar for a scope; text printed after it begins on a clean line.
class ProgressBarScope {
 public:
  explicit ProgressBarScope(std::optional<console::Progress>& bar) : bar_(bar) { bar_.emplace("driving"); }
  ProgressBarScope(const ProgressBarScope&) = delete;
  ProgressBarScope& operator=(const ProgressBarScope&) = delete;
  ~ProgressBarScope() { bar_.reset(); }

 private:
  std::optional<console::Progress>& bar_;
};

}  // namespace

void add_drive_options(console::Command command, DriveOptions& options) {
  add_connection(command, options.connection);
  add_json_flag(command, options.json);
  command.add_option("--record", options.record, "also record the drive into this MCAP file")
      .type_name("FILE");
}

void Steering::step(double v_mps, double omega_radps) {
  session_.set_velocity(v_mps, omega_radps);
  const std::uint64_t next_us = client_.device_time_us() + static_cast<std::uint64_t>(kStep.count());
  client_.pump_until([&] { return client_.device_time_us() >= next_us || console::interrupted(); }, kStep);
}

void Steering::hold(double v_mps, double omega_radps, microseconds duration) {
  const std::uint64_t end_us =
      client_.request(protocol::Ping{}).device_time_us + static_cast<std::uint64_t>(duration.count());
  while (client_.device_time_us() < end_us) step(v_mps, omega_radps);
  session_.stop();
}

void drive(DriveOptions& options, const DriveJob& job) {
  DriveRecording::check(options.record);
  const auto client = connect_to_drive(options.connection);
  job.connected(*client);
  std::optional<DriveRecording> recording;
  if (!options.record.empty()) recording.emplace(options.record, *client);
  Stopwatch stopwatch;
  OdometryWatch odometry(
      *client, recording ? experiment::kTelemetryPeriod_ms : kOdometryPeriod_ms,
      [&](const recording::OdometrySample& sample) {
        if (recording) recording->add(sample);
        stopwatch.moved_to(sample);
        job.moved(sample);
      },
      recording ? DriveRecording::kFields : OdometryWatch::kFields);
  const recording::OdometrySample start = odometry.fresh();
  try {
    robot::DriveHooks hooks = drive_hooks();
    hooks.segment_done = job.segment_done;
    hooks.interrupted = [&] { return console::interrupted() || (recording && recording->failed()); };
    robot::DriveSession session(*client, hooks);
    job.work(*client, session);
    session.end();
  } catch (const Interrupted&) {
    const recording::OdometrySample end = odometry.fresh();
    report(options, "interrupted", start, end, stopwatch.seconds());
    if (recording && recording->failed())
      console::say("the drive was ended because it could not be recorded; the robot is at rest and disarmed");
    if (recording) recording->close();
    throw;
  }
  const recording::OdometrySample end = odometry.fresh();
  if (recording) recording->close();
  report(options, "completed", start, end, stopwatch.seconds());
}

void drive_path(DriveOptions& options, const robot::Path& path) {
  PathProgress way(path);
  std::optional<console::Progress> bar;
  DriveJob job;
  job.connected = [&](robot::Client& client) { note_limits(client, path); };
  job.work = [&](robot::Client&, robot::DriveSession& session) {
    const ProgressBarScope showing(bar);
    session.run(path);
  };
  job.segment_done = [&](const protocol::SegmentDone& done) { way.segment_done(done.tag); };
  job.moved = [&](const recording::OdometrySample& sample) {
    if (!bar) return;
    way.moved_to(sample);
    const std::string part =
        way.segments() > 1 ? fmt::format("{}/{}  ", std::min(way.done() + 1, way.segments()), way.segments())
                           : "";
    bar->show(way.fraction(), part + in_short_words(pose_of(sample)));
  };
  drive(options, job);
}

void drive_velocity(DriveOptions& options, double v_mps, double omega_radps, double seconds) {
  std::optional<console::Progress> bar;
  std::int64_t begun_us = 0;
  DriveJob job;
  job.connected = [&](robot::Client& client) { note_limits(client, v_mps, omega_radps); };
  job.work = [&](robot::Client& client, robot::DriveSession& session) {
    const ProgressBarScope showing(bar);
    Steering(client, session).hold(v_mps, omega_radps, microseconds(std::llround(seconds * 1e6)));
  };
  job.moved = [&](const recording::OdometrySample& sample) {
    if (!bar) return;
    if (begun_us == 0) begun_us = sample.time_us;
    bar->show(static_cast<double>(sample.time_us - begun_us) / 1e6 / seconds,
              in_short_words(pose_of(sample)));
  };
  drive(options, job);
}

}  // namespace astro::commands
