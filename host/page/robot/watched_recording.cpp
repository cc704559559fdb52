#include "host/page/robot/watched_recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <utility>

#include "host/live/driver/publications.hpp"

namespace astro::page {
namespace {

/// "astro-2026-03-01T12-00-00Z.mcap": no character that some system refuses in a name.
std::string file_of(const std::filesystem::path& folder, const recording::RunInfo& info) {
  std::string stem = info.robot_name + "-" + info.started_at;
  for (char& each : stem)
    if (std::isalnum(static_cast<unsigned char>(each)) == 0) each = '-';
  std::string file = stem + ".mcap";
  for (int i = 2; std::filesystem::exists(folder / file); ++i) file = fmt::format("{}-{}.mcap", stem, i);
  return file;
}

/// The deviations of odometry are not known here: NaN.
ros2::msg::Telemetry to_message(const protocol::Telemetry& telemetry) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  live::BaseState state;
  state.time_ns = static_cast<std::int64_t>(telemetry.device_time_us) * 1000;
  state.covariance = {kUnknown, kUnknown, kUnknown, kUnknown, kUnknown, kUnknown};
  return live::telemetry(state, telemetry, live::Names(""));
}

}  // namespace

WatchedRecording::WatchedRecording(const std::filesystem::path& folder, recording::RunInfo info)
    : file_(file_of(folder, info)), info_(std::move(info)), writer_(folder / file_, info_) {}

void WatchedRecording::add(const protocol::Telemetry& telemetry,
                           const std::vector<recording::TruthSample>& truth) {
  const auto time_us = static_cast<std::int64_t>(telemetry.device_time_us);
  // The clock of a robot that has restarted begins again: the recording is of the time before.
  if (failure_ || (last_us_ && time_us <= *last_us_)) return;
  try {
    for (const recording::TruthSample& sample : truth)
      if (last_us_ && sample.time_us >= *last_us_) writer_.add(sample);
    if (const auto pose = gyro_poses_.next(telemetry); pose && last_us_) writer_.add(*pose);
    last_us_ = time_us;
    writer_.add(recording::to_sample(telemetry));
    writer_.add(to_message(telemetry), time_us);
  } catch (const Error& error) {
    failure_ = error;
  }
}

void WatchedRecording::close() {
  if (failure_) throw Error(*failure_);
  writer_.close(info_);
}

}  // namespace astro::page
