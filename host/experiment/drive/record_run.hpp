#pragma once

#include <cstdint>
#include <functional>

#include "host/experiment/files/plan.hpp"
#include "host/robot/motion/drive.hpp"
#include "host/robot/motion/paths.hpp"
#include "host/recording/run/run.hpp"
#include "host/truth/source/source.hpp"

namespace astro::experiment {

/// Between samples of odometry in a recording.
inline constexpr std::uint16_t kTelemetryPeriod_ms = 10;

/// What somebody in front of the program wants to know, and to say, while a robot drives.
struct RunHooks {
  /// The samples as they are recorded, and each segment as it ends: what a progress bar is made from.
  std::function<void(const recording::OdometrySample&)> moved = [](const auto&) {};
  std::function<void(std::uint16_t tag)> segment_done = [](std::uint16_t) {};
  std::function<void(const std::string&)> notice = [](const std::string&) {};
  std::function<bool()> interrupted = [] { return false; };
};

/// The path that a spec stands for.
robot::Path path_of(const Plan& plan, const RunSpec& spec);

/// Size, speed and names of a run before it is driven; robot and parameters are the caller's to add.
recording::RunInfo info_of(const Plan& plan, const RunSpec& spec);

/// Drives one run from rest to rest, starting at odometry pose 0, and records what the robot believed and
/// what the truth saw. The robot stands still for more than half a second at both ends, so that the poses
/// there can be averaged. Truth that comes afterwards is left to complete().
///
/// Throws what robot::DriveSession throws (the robot stands then), and astro::Error if the truth ends.
recording::Run record_run(robot::Client& client, truth::Source& truth, const robot::Path& path,
                          const recording::RunInfo& info, const RunHooks& hooks);

/// Adds the truth that comes only after a run: people and files are asked for it. Throws what they do; `run`
/// is as it was then.
void complete(recording::Run& run, truth::Source& truth);

/// Where samples go as they come, each stream in the order of its times.
struct SampleSink {
  std::function<void(const recording::OdometrySample&)> odometry;
  std::function<void(const recording::TruthSample&)> truth;
};

struct Recorded {
  std::uint64_t odometry = 0, truth = 0;  // samples
  std::string warning;                    // "" or why it ended before it was to
};

/// As above without driving: hands on whatever the robot does until `done` says so; asked after each message,
/// at least every 50 ms.
/// Holds no more than the last moments, however long it takes. A link or a truth that is lost on the way ends
/// it, and `warning` says so: nobody can drive the same again. What the sink throws ends it, too, and is
/// thrown.
Recorded record_until(robot::Client& client, truth::Source& truth, const SampleSink& sink,
                      const std::function<bool()>& done);

/// From the robot's fixed point to metres and radians.
recording::OdometrySample to_sample(const protocol::Telemetry& telemetry);

}  // namespace astro::experiment
