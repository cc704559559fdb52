#include "host/recording/files/run_writer.hpp"

#include <time.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "host/base/error.hpp"
#include "host/ros2/ros_messages.hpp"

namespace astro::recording {
namespace {

std::uint16_t add_topic(McapWriter& mcap, std::string_view topic, const ros2::RosType& type) {
  const std::uint16_t schema = mcap.add_schema(type.name, "ros2msg", type.definition);
  // Readers of bags need the key; empty means that the publisher's quality of service is unknown.
  return mcap.add_channel(schema, topic, "cdr", {{"offered_qos_profiles", ""}});
}

/// Microseconds since 1970 of "2024-06-11T12:00:00Z"; nothing if `text` is no such time.
std::optional<std::int64_t> utc_us(const std::string& text) {
  std::tm time{};
  const char* const end = strptime(text.c_str(), "%Y-%m-%dT%H:%M:%SZ", &time);
  if (end == nullptr || *end != '\0') return std::nullopt;
  const std::time_t seconds = timegm(&time);
  if (seconds < 0) return std::nullopt;
  return std::int64_t{seconds} * 1'000'000;
}

void keep_first(std::optional<double>& first, double heading_rad) {
  if (!first && std::isfinite(heading_rad)) first = heading_rad;
}

}  // namespace

RunWriter::RunWriter(const std::filesystem::path& path, const RunInfo& info, McapWriterOptions options)
    : path_(path),
      file_(path, PartFile::Replaces::recordings_too),
      mcap_([this](ByteView bytes) { file_.write(bytes); }, {"ros2", "astrolabe"}, options) {
  record_.info = info;
  mcap_.write_metadata({std::string(kRunRecordName), to_map(record_)});
  odometry_ = add_topic(mcap_, "/odom", ros2::odometry_type());
  counts_ = add_topic(mcap_, "/wheel_counts", ros2::wheel_counts_type());
  truth_ = add_topic(mcap_, "/truth", ros2::pose_stamped_type());
}

/// MCAP times cannot be negative; the stamp inside the message has the true time.
std::uint64_t RunWriter::log_time_ns(std::int64_t time_us) {
  if (!ros2::fits_stamp(time_us)) {
    throw Error(path_.string() + " cannot hold the time " + std::to_string(time_us) +
                " us: times are microseconds of the robot's clock, within 2^31 s");
  }
  if (!utc_offset_us_) {
    const auto started_us = utc_us(record_.info.started_at);
    utc_offset_us_ = started_us ? *started_us - time_us : 0;
  }
  return static_cast<std::uint64_t>(std::max<std::int64_t>(0, time_us + *utc_offset_us_)) * 1000;
}

void RunWriter::add(const OdometrySample& sample) {
  const std::uint64_t time_ns = log_time_ns(sample.time_us);
  keep_first(record_.first_odometry_heading_rad, sample.theta_rad);
  mcap_.write(odometry_, time_ns, ros2::encode_odometry(sample));
  mcap_.write(counts_, time_ns,
              ros2::encode_counts({sample.time_us, sample.left_counts, sample.right_counts}));
}

void RunWriter::add(const TruthSample& sample) {
  const std::uint64_t time_ns = log_time_ns(sample.time_us);
  if (sample.valid) keep_first(record_.first_truth_heading_rad, sample.theta_rad);
  mcap_.write(truth_, time_ns, ros2::encode_truth(sample));
}

void RunWriter::close(const RunInfo& final) {
  record_.info = final;
  mcap_.write_metadata({std::string(kRunRecordName), to_map(record_)});
  mcap_.close();
  file_.commit();
}

}  // namespace astro::recording
