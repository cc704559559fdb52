#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "host/base/error.hpp"
#include "host/experiment/files/plan.hpp"
#include "host/recording/run.hpp"
#include "host/robot/motion/drive.hpp"
#include "host/robot/motion/paths.hpp"
#include "host/truth/source/source.hpp"

namespace astro::experiment {

/// Between samples of odometry in a recording.
inline constexpr std::uint16_t kTelemetryPeriod_ms = 10;

/// Callbacks for progress, notices and interruption while a robot drives.
struct RunHooks {
  /// Called for each recorded sample and for each segment that ends, for a progress bar.
  std::function<void(const recording::OdometrySample&)> moved = [](const auto&) {};
  std::function<void(std::uint16_t tag)> segment_done = [](std::uint16_t) {};
  std::function<void(const Remark&)> notice = [](const Remark&) {};
  std::function<bool()> interrupted = [] { return false; };
  std::function<void()> resting = [] {};  // as robot::DriveHooks has it
};

/// The path of a run.
robot::Path path_of(const Plan& plan, const RunSpec& spec);

/// Size, speed and names of a run before it is driven; the caller adds robot and parameters.
recording::RunInfo info_of(const Plan& plan, const RunSpec& spec);

/// The robot with its parameters and the time, of a drive that begins now and follows no plan.
recording::RunInfo info_of(const protocol::HelloReply& robot,
                           const std::map<std::string, double>& parameters);

/// Drives one run from rest to rest, starting at odometry pose 0, and records odometry
/// and truth. The robot stands still for more than half a second at both ends, so that the poses
/// there can be averaged. Truth that is measured afterwards is added by complete(). The robot is not armed before
/// truth comes. Of a laser scanner on the robot truth is where its scans say that the robot was; if they do not tell, that is a
/// notice, and the run has scans and no truth. Turns without wheels that the robot's gyro noticed are a notice, too.
///
/// Throws what robot::DriveSession throws (the robot stands then), and astro::Error if the truth does not come or ends.
recording::Run record_run(robot::Client& client, truth::Source& truth, const robot::Path& path,
                          const recording::RunInfo& info, const RunHooks& hooks);

/// Adds the truth that is available only after a run, from a person or a file. Returns false if the person wants the run
/// driven again. Throws what the source throws; `run` is unchanged in both cases.
[[nodiscard]] bool complete(recording::Run& run, truth::Source& truth);

/// Receives the samples, each stream in order of time.
struct SampleSink {
  std::function<void(const recording::OdometrySample&)> odometry;
  std::function<void(const recording::TruthSample&)> truth;
  std::function<void(const lidar::Scan&)> scan = [](const lidar::Scan&) {};
  std::function<void(const recording::GyroSlip&)> slip = [](const recording::GyroSlip&) {};
  std::function<void(const recording::GyroPose&)> gyro = [](const recording::GyroPose&) {};
};

struct Recorded {
  std::uint64_t odometry = 0, truth = 0, scans = 0, slips = 0;  // samples
  std::optional<Remark> warning;                                // why the recording ended early
};

/// Records without driving, until `done` returns true; it is called after each message, at least every 50 ms.
/// Memory does not grow with time. If the link or the truth is lost, the recording ends with a `warning` and
/// not with an error, because the drive cannot be repeated. An exception of the sink ends it and is passed on.
Recorded record_until(robot::Client& client, truth::Source& truth, const SampleSink& sink,
                      const std::function<bool()>& done);

}  // namespace astro::experiment
