#include "host/recording/log_time.hpp"

#include <algorithm>
#include <utility>

#include "host/base/error.hpp"
#include "host/base/utc.hpp"
#include "host/formats/messages/ros_messages.hpp"
#include "host/recording/recording_problem.hpp"

namespace astro::recording {

LogTime::LogTime(std::filesystem::path file, std::string started_at)
    : file_(std::move(file)), started_at_(std::move(started_at)) {}

std::int64_t LogTime::ns(std::int64_t time_us) {
  if (!ros2::fits_stamp(time_us)) {
    throw Error(file_.string() + " cannot hold the time " + std::to_string(time_us) +
                    " us: times are microseconds of the robot's clock, within 2^31 s",
                RecordingProblem::time_out_of_range, {file_.string(), std::to_string(time_us)});
  }
  if (!utc_offset_us_) {
    const auto started = utc_time(started_at_);
    utc_offset_us_ = started ? started->time_since_epoch().count() - time_us : 0;
  }
  return std::max<std::int64_t>(0, time_us + *utc_offset_us_) * 1000;
}

}  // namespace astro::recording
