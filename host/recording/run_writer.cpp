#include "host/recording/run_writer.hpp"

#include <cmath>

#include "host/formats/cdr/codec.hpp"
#include "host/formats/messages/joint_state.hpp"
#include "host/formats/messages/ros_messages.hpp"
#include "host/formats/messages/stamped_pose.hpp"
#include "host/formats/messages/text_message.hpp"
#include "host/recording/sample_messages.hpp"

namespace astro::recording {
namespace {

std::uint16_t add_topic(bag::McapWriter& mcap, std::string_view topic, const ros2::RosType& type) {
  const std::uint16_t schema = mcap.add_schema(type.name, "ros2msg", type.definition);
  // Readers of bags need the key; empty means that the publisher's quality of service is unknown.
  return mcap.add_channel(schema, topic, "cdr", {{"offered_qos_profiles", ""}});
}

void keep_first(std::optional<double>& first, double heading_rad) {
  if (!first && std::isfinite(heading_rad)) first = heading_rad;
}

}  // namespace

RunWriter::RunWriter(const std::filesystem::path& path, const RunInfo& info, bag::McapWriterOptions options)
    : file_(path, PartFile::Replaces::recordings_too),
      mcap_([this](ByteView bytes) { file_.write(bytes); }, {"ros2", "astrolabe"}, options),
      log_time_(path, info.started_at),
      robot_(info) {
  record_.info = info;
  mcap_.write_metadata({std::string(kRunRecordName), to_map(record_)});
  odometry_ = add_topic(mcap_, "/odom", ros2::odometry_type());
  counts_ = add_topic(mcap_, "/wheel_counts", recording::wheel_counts_type());
  truth_ = add_topic(mcap_, "/truth", ros2::pose_stamped_type());
  transforms_ = add_topic(mcap_, "/tf", ros2::tf_message_type());
  if (!robot_.knows_sizes()) return;
  joints_ = add_topic(mcap_, "/joint_states", ros2::joint_state_type());
  description_ = add_topic(mcap_, "/robot_description", ros2::string_type());
}

/// Writes the first message, so that a viewer knows the robot before it moves.
void RunWriter::describe(std::uint64_t time_ns) {
  if (robot_.knows_sizes() && !described_) mcap_.write(description_, time_ns, robot_.description());
  described_ = true;
}

/// Transforms and joints are what a screen shows, and follow from the other messages, so that 50 a second are enough.
bool RunWriter::viewers_are_due(std::int64_t time_us) const {
  constexpr std::int64_t kPeriod_us = 20'000;
  return !shown_us_ || time_us < *shown_us_ || time_us - *shown_us_ >= kPeriod_us;
}

void RunWriter::add(const OdometrySample& sample) {
  const std::uint64_t time_ns = static_cast<std::uint64_t>(log_time_.ns(sample.time_us));
  keep_first(record_.first_odometry_heading_rad, sample.theta_rad);
  describe(time_ns);
  robot_.advance(sample);
  mcap_.write(odometry_, time_ns, recording::encode_odometry(sample));
  mcap_.write(counts_, time_ns,
              recording::encode_counts({sample.time_us, sample.left_counts, sample.right_counts}));
  if (!viewers_are_due(sample.time_us)) return;
  shown_us_ = sample.time_us;
  mcap_.write(transforms_, time_ns, robot_.transforms());
  if (robot_.knows_sizes()) mcap_.write(joints_, time_ns, robot_.joints());
}

void RunWriter::add(const TruthSample& sample) {
  const std::uint64_t time_ns = static_cast<std::uint64_t>(log_time_.ns(sample.time_us));
  if (sample.valid) keep_first(record_.first_truth_heading_rad, sample.theta_rad);
  describe(time_ns);
  mcap_.write(truth_, time_ns, recording::encode_truth(sample));
}

void RunWriter::add(const lidar::Scan& scan) {
  const auto time_ns = static_cast<std::uint64_t>(log_time_.ns(scan.time_ns / 1000));
  if (!scans_) scans_ = add_topic(mcap_, "/scan", recording::laser_scan_type());
  describe(time_ns);
  mcap_.write(*scans_, time_ns, recording::encode_scan(scan));
}

void RunWriter::add(const GyroPose& pose) {
  const auto time_ns = static_cast<std::uint64_t>(log_time_.ns(pose.time_us));
  if (!gyro_poses_) gyro_poses_ = add_topic(mcap_, "/odom_gyro", ros2::odometry_type());
  describe(time_ns);
  mcap_.write(*gyro_poses_, time_ns, recording::encode_gyro_pose(pose));
}

void RunWriter::add(const GyroSlip& slip) {
  const auto time_ns = static_cast<std::uint64_t>(log_time_.ns(slip.time_us));
  if (!slips_) slips_ = add_topic(mcap_, "/gyro_slip", recording::gyro_slip_type());
  describe(time_ns);
  mcap_.write(*slips_, time_ns, recording::encode_slip(slip));
}

void RunWriter::add(const ros2::msg::Telemetry& telemetry, std::int64_t time_us) {
  if (!telemetry_) telemetry_ = add_topic(mcap_, "/telemetry", ros2::ros_type<ros2::msg::Telemetry>());
  mcap_.write(*telemetry_, static_cast<std::uint64_t>(log_time_.ns(time_us)), ros2::encode(telemetry));
}

void RunWriter::close(const RunInfo& final) {
  record_.info = final;
  mcap_.write_metadata({std::string(kRunRecordName), to_map(record_)});
  mcap_.close();
  file_.commit();
}

}  // namespace astro::recording
