#pragma once

#include <exception>
#include <filesystem>

#include "host/robot/client/client.hpp"
#include "host/recording/files/run_writer.hpp"

namespace astro::commands {

/// The robot and its parameters as they are now, and the time: the beginning of what a recording says of
/// itself.
recording::RunInfo describe_robot(robot::Client& client);

/// A recording of what a robot does while this program drives it. Without ground truth.
class DriveRecording {
 public:
  static constexpr std::uint32_t kFields =
      protocol::Telemetry::kPose | protocol::Telemetry::kCounts | protocol::Telemetry::kTwist;

  /// Throws astro::Error if `file` exists, because a recording replaces nothing. Nothing if it is empty.
  static void check(const std::filesystem::path& file);

  DriveRecording(const std::filesystem::path& file, robot::Client& client);
  /// The file gets its name, however the drive has ended.
  ~DriveRecording();
  DriveRecording(const DriveRecording&) = delete;
  DriveRecording& operator=(const DriveRecording&) = delete;

  /// Nothing any more once a sample could not be written: it is called amid a drive, which has to end in good
  /// order before anybody hears of it: the drive is to end where failed() is true, and close() says why.
  void add(const recording::OdometrySample& sample);
  bool failed() const { return failure_ != nullptr; }

  /// The same as the destructor, and throws where it cannot be written.
  void close();

 private:
  recording::RunInfo info_;
  recording::RunWriter writer_;
  bool open_ = true;
  std::exception_ptr failure_;
};

}  // namespace astro::commands
