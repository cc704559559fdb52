#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace astro::recording {

/// The times by which viewers order a run's messages: UTC, so that they show when the run was driven and not 1970. The
/// first message is at the run's start, the others at their distance from it by the robot's clock. Without a start they
/// are the robot's clock, too.
class LogTime {
 public:
  /// `started_at`: ISO 8601, UTC; `file` is named in errors.
  LogTime(std::filesystem::path file, std::string started_at);

  /// Never negative: MCAP cannot hold that, and the stamp inside the message has the true time. Throws astro::Error
  /// for a time that a stamp cannot hold, which is one not within +-2^31 s.
  std::int64_t ns(std::int64_t time_us);

 private:
  std::filesystem::path file_;
  std::string started_at_;
  std::optional<std::int64_t> utc_offset_us_;  // UTC minus the robot's clock; set by the first message
};

}  // namespace astro::recording
