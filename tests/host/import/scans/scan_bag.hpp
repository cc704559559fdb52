#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "host/formats/cdr/codec.hpp"
#include "host/formats/files/mcap_writer.hpp"
#include "host/formats/messages/joint_state.hpp"
#include "host/formats/messages/sensors.hpp"
#include "tests/host/lidar/synthetic_room.hpp"

namespace astro::importing {

inline constexpr double kWheelDiameter_m = 0.066;

/// A synthetic drive as a robot of ROS 2 records it: /joint_states, and scans on each of these topics.
inline void write_scan_bag(const std::filesystem::path& path, const lidar::SyntheticDrive& drive,
                           const std::vector<std::string>& scan_topics, std::int64_t start_ns) {
  using ros2::msg::LaserScan;
  const lidar::ScannedDrive recorded = drive.recorded();
  Bytes file;
  bag::McapWriter writer([&](ByteView bytes) { append(file, bytes); }, {"ros2", "test"});
  const auto joints = writer.add_channel(writer.add_schema(ros2::joint_state_type().name, "ros2msg", ""),
                                         "/joint_states", "cdr", {});
  for (const calibration::WheelSample& sample : recorded.wheels) {
    const std::int64_t time_ns = start_ns + std::llround(1e9 * sample.time_s);
    writer.write(joints, static_cast<std::uint64_t>(time_ns + 1'000'000),
                 ros2::encode_joint_state(
                     {time_ns,
                      {"wheel_left_joint", "wheel_right_joint"},
                      {2 * sample.left_m / kWheelDiameter_m, 2 * sample.right_m / kWheelDiameter_m},
                      {},
                      {}}));
  }
  const auto schema = writer.add_schema(LaserScan::kType, "ros2msg", ros2::ros_type<LaserScan>().definition);
  for (const std::string& topic : scan_topics) {
    const auto channel = writer.add_channel(schema, topic, "cdr", {});
    recorded.read_scans([&](const lidar::Scan& scan) {
      const std::int64_t time_ns = start_ns + scan.time_ns;
      LaserScan message;
      message.header.stamp = ros2::msg::to_time(time_ns);
      message.angle_min = static_cast<float>(scan.first_angle_rad);
      message.angle_increment = static_cast<float>(scan.angle_step_rad);
      message.time_increment = static_cast<float>(scan.beam_interval_s);
      message.range_min = static_cast<float>(scan.range_min_m);
      message.range_max = static_cast<float>(scan.range_max_m);
      message.ranges = scan.ranges_m;
      writer.write(channel, static_cast<std::uint64_t>(time_ns + 150'000'000), ros2::encode(message));
    });
  }
  writer.close();
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(file.data()), static_cast<std::streamsize>(file.size()));
}

/// Messages on /scan.
inline void write_scans(const std::filesystem::path& path, const std::vector<ros2::msg::LaserScan>& scans) {
  using ros2::msg::LaserScan;
  Bytes file;
  bag::McapWriter writer([&](ByteView bytes) { append(file, bytes); }, {"ros2", "test"});
  const auto channel = writer.add_channel(
      writer.add_schema(LaserScan::kType, "ros2msg", ros2::ros_type<LaserScan>().definition), "/scan", "cdr",
      {});
  for (const LaserScan& scan : scans) writer.write(channel, 1, ros2::encode(scan));
  writer.close();
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(file.data()), static_cast<std::streamsize>(file.size()));
}

}  // namespace astro::importing
