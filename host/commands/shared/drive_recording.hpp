#pragma once

#include <cstdint>
#include <exception>
#include <filesystem>
#include <optional>

#include "host/recording/run_writer.hpp"
#include "host/recording/telemetry_sample.hpp"
#include "host/robot/client/client.hpp"

namespace astro::commands {

/// The robot, its parameters and the time, for the metadata of a recording.
recording::RunInfo describe_robot(robot::Client& client);

/// Records what a robot does while this program drives it, without ground truth.
class DriveRecording {
 public:
  static constexpr std::uint32_t kFields = protocol::Telemetry::kPose | protocol::Telemetry::kCounts |
                                           protocol::Telemetry::kTwist | protocol::Telemetry::kFused;

  /// Throws astro::Error if `file` exists, because a recording replaces nothing. Does nothing if it is empty.
  static void check(const std::filesystem::path& file);

  DriveRecording(const std::filesystem::path& file, robot::Client& client);
  /// The file gets its final name, however the drive has ended.
  ~DriveRecording();
  DriveRecording(const DriveRecording&) = delete;
  DriveRecording& operator=(const DriveRecording&) = delete;

  /// If a sample cannot be written, it does not throw, because it is called during a drive, which must end in
  /// good order first. Then failed() is true, all further samples are ignored, the drive should be ended, and
  /// close() throws the error.
  void add(const recording::OdometrySample& sample);
  bool failed() const { return failure_ != nullptr; }

  /// As the destructor, but throws if the recording could not be written.
  void close();

 private:
  template <class Sample>
  void write_since_start(const Sample& sample);
  template <class Sample>
  void write(const Sample& sample);

  recording::RunInfo info_;
  recording::RunWriter writer_;
  bool open_ = true;
  std::optional<std::int64_t> first_us_;  // of the odometry
  std::exception_ptr failure_;
  recording::RecordedGyroPoses gyro_poses_;
  robot::Subscription slips_, gyro_;
};

}  // namespace astro::commands
