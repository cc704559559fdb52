#pragma once

#include <lz4frame.h>

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "host/base/files.hpp"
#include "host/base/pose2.hpp"
#include "host/calibration/motion/arc.hpp"
#include "host/formats/files/compression.hpp"
#include "host/formats/files/mcap_records.hpp"
#include "host/formats/messages/geometry.hpp"
#include "host/formats/messages/joint_state.hpp"
#include "host/formats/messages/ros_messages.hpp"
#include "host/formats/messages/sensors.hpp"
#include "host/formats/messages/stamped_pose.hpp"
#include "host/recording/run_file.hpp"
#include "tests/host/import/drives/drive_files.hpp"
#include "tests/support/base/gzip.hpp"
#include "tests/support/ros1/ros1_bag.hpp"

/// One short drive in every format that is imported, small enough to be damaged a thousand times.
namespace astro::test {

inline void save(const fs::path& path, ByteView bytes) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}
inline void save(const fs::path& path, const std::string& text) { save(path, as_bytes(text)); }

/// A robot with two equal wheels that drives a winding line for 12 s, seen at 10 Hz.
inline calibration::Trajectory short_drive() {
  constexpr double kWheelbase_m = 0.29, kStep_s = 0.1;
  calibration::Trajectory drive;
  double x_m = 0, y_m = 0, theta_rad = 0, left_m = 0, right_m = 0;
  for (int i = 0; i < 120; ++i) {
    const double time_s = kStep_s * i, step_m = kStep_s * 0.3, turn_rad = kStep_s * std::sin(0.8 * time_s);
    drive.wheels.push_back({time_s, left_m, right_m});
    drive.truth.push_back({time_s, x_m, y_m, theta_rad});
    x_m += step_m * std::cos(theta_rad + turn_rad / 2);
    y_m += step_m * std::sin(theta_rad + turn_rad / 2);
    theta_rad += turn_rad;
    left_m += step_m - turn_rad * kWheelbase_m / 2;
    right_m += step_m + turn_rad * kWheelbase_m / 2;
  }
  return drive;
}

inline Bytes lz4(ByteView bytes) {
  Bytes out(LZ4F_compressFrameBound(bytes.size(), nullptr));
  out.resize(LZ4F_compressFrame(out.data(), out.size(), bytes.data(), bytes.size(), nullptr));
  return out;
}

inline Bytes packed(const std::string& compression, ByteView bytes) {
  if (compression == "zstd") return bag::compress_zstd(bytes);
  return compression == "lz4" ? lz4(bytes) : Bytes(bytes.begin(), bytes.end());
}

/// A file of MCAP as recorders of ROS 2 write it, put together by hand: checksums of zero are not looked at, so damage
/// reaches what is behind them.
class McapBag {
 public:
  explicit McapBag(std::string compression) : compression_(std::move(compression)) {
    append(file_, ByteView(bag::mcap::kMagic));
    record(bag::mcap::Op::header, bag::mcap::encode(bag::mcap::Header{"ros2", "test"}));
  }

  void topic(std::uint16_t id, std::string_view name, std::string_view type) {
    using namespace bag::mcap;  // NOLINT(google-build-using-namespace): its records alone
    append_record(chunk_, Op::schema, encode(Schema{id, std::string(type), "ros2msg", ""}));
    append_record(chunk_, Op::channel, encode(Channel{id, id, std::string(name), "cdr", {}}));
  }
  void message(std::uint16_t topic, std::int64_t time_ns, ByteView data) {
    const auto time = static_cast<std::uint64_t>(time_ns);
    bag::mcap::append_message(chunk_, {topic, 0, time, time, data});
  }
  std::size_t open_bytes() const { return chunk_.size(); }
  void end_chunk() { add_chunk(packed(compression_, chunk_), chunk_.size()), chunk_.clear(); }
  /// A chunk that says of itself what it likes.
  void add_chunk(ByteView packed_records, std::uint64_t claimed_bytes) {
    record(bag::mcap::Op::chunk,
           bag::mcap::encode(bag::mcap::Chunk{0, 0, claimed_bytes, 0, compression_, packed_records}));
  }
  const Bytes& file() const { return file_; }
  const Bytes& closed() {
    if (!chunk_.empty()) end_chunk();
    record(bag::mcap::Op::data_end, Bytes(4));
    record(bag::mcap::Op::footer, Bytes(20));
    append(file_, ByteView(bag::mcap::kMagic));
    return file_;
  }

 private:
  void record(bag::mcap::Op op, ByteView content) { append_record(file_, op, content); }

  std::string compression_;
  Bytes file_, chunk_;
};

inline constexpr std::string_view kJointType = "sensor_msgs/msg/JointState",
                                  kTfType = "tf2_msgs/msg/TFMessage";

inline Bytes mcap_bag(const calibration::Trajectory& run, const std::string& compression) {
  constexpr std::int64_t kStart_ns = 1'700'000'000'000'000'000;
  McapBag bag(compression);
  bag.topic(1, "/joint_states", kJointType);
  bag.topic(2, "/tracker/pose", "geometry_msgs/msg/PoseStamped");
  for (std::size_t i = 0; i < run.wheels.size(); ++i) {
    const auto& wheels = run.wheels[i];
    const std::int64_t time_ns = kStart_ns + std::llround(1e9 * wheels.time_s);
    bag.message(1, time_ns,
                ros2::encode_joint_state({time_ns,
                                          {"wheel_left_joint", "wheel_right_joint"},
                                          {2 * wheels.left_m / kDiameter_m, 2 * wheels.right_m / kDiameter_m},
                                          {},
                                          {}}));
    bag.message(2, time_ns, pose_stamped(time_ns, pose_of(run.truth[i])));
  }
  return bag.closed();
}

inline constexpr std::int64_t kRos1Start_ns = 1'600'000'000'000'000'000;

inline ros2::msg::Header header_at(std::int64_t time_ns) { return {ros2::msg::to_time(time_ns), "map"}; }

inline std::int64_t ros1_time_ns(double time_s) { return kRos1Start_ns + std::llround(1e9 * time_s); }

inline Bytes ros1_bag(const calibration::Trajectory& run, const std::string& compression) {
  support::Ros1Bag bag(compression);
  bag.topic(1, "/joint_states", "sensor_msgs/JointState", support::ros1::kJointState);
  bag.topic(2, "/tracker/pose", "geometry_msgs/PoseStamped", support::ros1::kPoseStamped);
  for (const auto& at : run.wheels) {
    const std::int64_t time_ns = ros1_time_ns(at.time_s);
    const ros2::msg::JointState state{header_at(time_ns),
                                      {"wheel_left_joint", "wheel_right_joint"},
                                      {2 * at.left_m / kDiameter_m, 2 * at.right_m / kDiameter_m},
                                      {},
                                      {}};
    bag.message(1, time_ns, support::Ros1Message::encode(state));
  }
  bag.end_chunk();
  for (const auto& at : run.truth) {
    const std::int64_t time_ns = ros1_time_ns(at.time_s);
    const BodyPose p = pose_of(at);
    const ros2::msg::PoseStamped pose{header_at(time_ns), {{p.x, p.y, p.z}, {p.qx, p.qy, p.qz, p.qw}}};
    bag.message(2, time_ns, support::Ros1Message::encode(pose));
  }
  return bag.closed();
}

/// A topic of counts for each wheel, and a tracker that publishes transforms.
inline Bytes ros1_bag_of_counts(const calibration::Trajectory& run) {
  support::Ros1Bag bag;
  bag.topic(1, "/lwheel_ticks", "std_msgs/Int32", "int32 data\n");
  bag.topic(2, "/rwheel_ticks", "std_msgs/Int32", "int32 data\n");
  bag.topic(3, "/vicon/tf", "tf2_msgs/TFMessage", support::ros1::kTf);
  const auto counts = [](double way_m) {
    Bytes bytes;
    append(bytes, static_cast<std::int32_t>(std::llround(way_m / kMetresPerCount)));
    return bytes;
  };
  for (const auto& at : run.wheels) {
    bag.message(1, ros1_time_ns(at.time_s), counts(at.left_m));
    bag.message(2, ros1_time_ns(at.time_s), counts(at.right_m));
  }
  for (const auto& at : run.truth) {
    const std::int64_t time_ns = ros1_time_ns(at.time_s);
    const BodyPose p = pose_of(at);
    const ros2::msg::TransformStamped transform{
        header_at(time_ns), "robot", {{p.x, p.y, p.z}, {p.qx, p.qy, p.qz, p.qw}}};
    bag.message(3, time_ns, support::Ros1Message::encode(ros2::msg::TFMessage{{transform}}));
  }
  return bag.closed();
}

/// The robot's own odometry by these factors, and a tracker.
inline Bytes ros1_bag_of_odometry(const calibration::Trajectory& run,
                                  const calibration::WheelFactors& factors) {
  support::Ros1Bag bag("bz2");
  bag.topic(1, "/odom", "nav_msgs/Odometry", support::ros1::kOdometry);
  bag.topic(2, "/vrpn_client_node/robot/pose", "geometry_msgs/PoseStamped", support::ros1::kPoseStamped);
  Pose2 pose;
  for (std::size_t i = 0; i < run.wheels.size(); ++i) {
    const auto& at = run.wheels[i];
    const auto& before = run.wheels[i == 0 ? 0 : i - 1];
    calibration::advance(pose, at.right_m - before.right_m, at.left_m - before.left_m, factors);
    ros2::msg::Odometry odometry;
    odometry.header = header_at(ros1_time_ns(at.time_s));
    odometry.child_frame_id = "base_link";
    odometry.pose.pose = ros2::planar_pose(pose.x_m, pose.y_m, pose.theta_rad);
    bag.message(1, ros1_time_ns(at.time_s), support::Ros1Message::encode(odometry));
  }
  for (const auto& at : run.truth) {
    const BodyPose p = pose_of(at);
    const ros2::msg::PoseStamped truth{header_at(ros1_time_ns(at.time_s)),
                                       {{p.x, p.y, p.z}, {p.qx, p.qy, p.qz, p.qw}}};
    bag.message(2, ros1_time_ns(at.time_s), support::Ros1Message::encode(truth));
  }
  return bag.closed();
}

inline recording::Run own_run(const calibration::Trajectory& drive) {
  recording::Run run;
  run.info.kind = "free";
  run.info.parameters = {{"wheel_diameter", kDiameter_m},
                         {"counts_per_motor_rev", kCountsPerTurn},
                         {"gear_numerator", 1},
                         {"gear_denominator", 1},
                         {"c_R", 1},
                         {"c_L", 1},
                         {"b", 0.29}};
  for (std::size_t i = 0; i < drive.wheels.size(); ++i) {
    const auto& wheels = drive.wheels[i];
    const auto& truth = drive.truth[i];
    const std::int64_t time_us = std::llround(1e6 * wheels.time_s);
    run.odometry.push_back({time_us, truth.x_m, truth.y_m, truth.theta_rad, 0.3, 0,
                            static_cast<std::int32_t>(std::llround(wheels.left_m / kMetresPerCount)),
                            static_cast<std::int32_t>(std::llround(wheels.right_m / kMetresPerCount))});
    run.truth.push_back({time_us, truth.x_m, truth.y_m, truth.theta_rad, true});
  }
  return run;
}

inline const std::string kRobotToml =
    "# sizes\n[parameters]\nwheel_diameter = 0.084\ncounts_per_motor_rev = 4096\nb = 0.29 # m\nc_R = 1.001\n"
    "c_L = 0.999\n[robot]\nname = \"astro\"\nid = \"7\"\n[nominal]\nwheel_diameter = 0.084\n";

inline const std::string kRobotYaml =
    "controller_manager:\n  ros__parameters:\n    update_rate: 100\nbase:\n  ros__parameters:\n"
    "    left_wheel_names: [\"wheel_left_joint\"]\n    right_wheel_names: ['wheel_right_joint']\n"
    "    wheel_separation: 0.29\n    wheel_radius: &r 0.042\n    wheel_separation_multiplier: 1.0\n"
    "    left_wheel_radius_multiplier: 0.999 # measured\n    pose_covariance_diagonal: [0.001, 0.001]\n";

/// What a file holds of a drive.
enum class Holds { wheels, truth, both, robot };

/// `name` is that of the file, whose end decides for settings alone.
struct FileSample {
  std::string format, name;
  Holds holds;
  bool is_text;
  Bytes bytes;
};

inline constexpr std::size_t kFileSamples = 21;

/// Makes all kFileSamples below `folder`.
inline std::vector<FileSample> file_samples(const fs::path& folder) {
  const calibration::Trajectory drive = short_drive();
  const auto text = [](const fs::path& path) { return load_file(path); };
  const auto of = [](const std::string& words) { return Bytes(words.begin(), words.end()); };
  const fs::path made = folder / "made";
  const Bytes counts = text(write_counts(made, drive)), motive = text(write_motive(made, drive)),
              tum = text(write_tum(made, drive)), plain = text(write_plain_millimetres(made, drive));
  std::string vicon =
      "Objects\r\n10\r\n,,Global Angle astro:astro,,,,,\r\nFrame,Sub Frame,RX,RY,RZ,TX,TY,TZ\r\n"
      ",,rad,rad,rad,mm,mm,mm\r\n";
  std::string euroc = "#timestamp [ns],x,y,z,qw,qx,qy,qz\n";
  int frame = 0;
  for (const auto& at : drive.truth) {
    const BodyPose p = pose_of(at);
    vicon += fmt::format("{},0,0,0,{:.9f},{:.6f},{:.6f},{:.6f}\r\n", ++frame, at.theta_rad, 1000 * p.x,
                         1000 * p.y, 1000 * p.z);
    euroc += fmt::format("{},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f}\n",
                         1'403'715'529'000'000'000 + std::llround(1e9 * at.time_s), p.x, p.y, p.z, p.qw, p.qx,
                         p.qy, p.qz);
  }
  const Bytes database = text(write_bag(folder / "bag", drive) / "bag_0.db3");
  recording::write_run(folder / "own", own_run(drive));
  const Bytes own = text(folder / "own"), stored = mcap_bag(drive, "");
  return {{"Motive CSV", "x.csv", Holds::truth, true, motive},
          {"Vicon CSV", "x.csv", Holds::truth, true, of(vicon)},
          {"TUM", "x.tum", Holds::truth, true, tum},
          {"EuRoC", "x.csv", Holds::truth, true, of(euroc)},
          {"plain CSV of truth", "x.csv", Holds::truth, true, plain},
          {"CSV of wheels", "x.csv", Holds::wheels, true, counts},
          {"gzip of truth", "x.csv.gz", Holds::truth, false, support::gzip(std::string(as_text(motive)))},
          {"gzip of wheels", "x.csv.gz", Holds::wheels, false, support::gzip(std::string(as_text(counts)))},
          {"rosbag2 db3", "x.db3", Holds::both, false, database},
          {"rosbag2 db3, packed", "x.db3.zstd", Holds::both, false, bag::compress_zstd(database)},
          {"MCAP of ROS 2, stored", "x.mcap", Holds::both, false, stored},
          {"MCAP of ROS 2, lz4", "x.mcap", Holds::both, false, mcap_bag(drive, "lz4")},
          {"MCAP of ROS 2, zstd", "x.mcap", Holds::both, false, mcap_bag(drive, "zstd")},
          {"MCAP of ROS 2, packed", "x.mcap.zstd", Holds::both, false, bag::compress_zstd(stored)},
          {"ROS 1 bag, stored", "x.bag", Holds::both, false, ros1_bag(drive, "none")},
          {"ROS 1 bag, bz2", "x.bag", Holds::both, false, ros1_bag(drive, "bz2")},
          {"ROS 1 bag, lz4", "x.bag", Holds::both, false, ros1_bag(drive, "lz4")},
          {"ROS 1 bag of counts and transforms", "x.bag", Holds::both, false, ros1_bag_of_counts(drive)},
          {"our MCAP", "x.mcap", Holds::both, false, own},
          {"robot TOML", "x.toml", Holds::robot, true, of(kRobotToml)},
          {"robot YAML", "x.yaml", Holds::robot, true, of(kRobotYaml)}};
}

}  // namespace astro::test
