#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/protocol/telemetry.hpp"
#include "host/base/error.hpp"
#include "host/recording/run.hpp"
#include "host/recording/run_writer.hpp"
#include "host/recording/telemetry_sample.hpp"

namespace astro::page {

/// Writes what the robot does into an MCAP file while it is watched: odometry, counts, truth, and the rest of its telemetry for
/// plots. The file is one that a calibration reads.
class WatchedRecording {
 public:
  /// Names the file after the robot's name and the time, so that it replaces none. Throws astro::Error if it cannot be written.
  WatchedRecording(const std::filesystem::path& folder, recording::RunInfo info);

  /// Throws nothing: if the disk is full, the robot has to be driven on. The error is that of close().
  void add(const protocol::Telemetry& telemetry, const std::vector<recording::TruthSample>& truth);

  const std::string& file() const { return file_; }
  /// Gives the file its name. Throws astro::Error if anything could not be written.
  void close();

 private:
  std::string file_;  // without the folder
  recording::RunInfo info_;
  recording::RunWriter writer_;
  recording::RecordedGyroPoses gyro_poses_;
  std::optional<std::int64_t> last_us_;
  std::optional<Error> failure_;
};

}  // namespace astro::page
