#include "host/recording/files/log_time.hpp"

#include <time.h>

#include <algorithm>
#include <ctime>
#include <utility>

#include "host/base/error.hpp"
#include "host/ros2/ros_messages.hpp"

namespace astro::recording {
namespace {

/// Microseconds since 1970 of "2024-06-11T12:00:00Z"; nothing if `text` is no such time.
std::optional<std::int64_t> utc_us(const std::string& text) {
  std::tm time{};
  const char* const end = strptime(text.c_str(), "%Y-%m-%dT%H:%M:%SZ", &time);
  if (end == nullptr || *end != '\0') return std::nullopt;
  const std::time_t seconds = timegm(&time);
  if (seconds < 0) return std::nullopt;
  return std::int64_t{seconds} * 1'000'000;
}

}  // namespace

LogTime::LogTime(std::filesystem::path file, std::string started_at)
    : file_(std::move(file)), started_at_(std::move(started_at)) {}

std::int64_t LogTime::ns(std::int64_t time_us) {
  if (!ros2::fits_stamp(time_us)) {
    throw Error(file_.string() + " cannot hold the time " + std::to_string(time_us) +
                " us: times are microseconds of the robot's clock, within 2^31 s");
  }
  if (!utc_offset_us_) {
    const auto started_us = utc_us(started_at_);
    utc_offset_us_ = started_us ? *started_us - time_us : 0;
  }
  return std::max<std::int64_t>(0, time_us + *utc_offset_us_) * 1000;
}

}  // namespace astro::recording
