#include "tests/support/bags/turtlebot_bag.hpp"

#include <cmath>
#include <deque>
#include <functional>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <utility>

#include "host/base/files.hpp"
#include "host/formats/cdr/codec.hpp"
#include "host/formats/files/db3_writer.hpp"
#include "host/formats/files/mcap_writer.hpp"
#include "host/formats/messages/ros_messages.hpp"
#include "host/formats/messages/sensors.hpp"
#include "host/recording/telemetry_sample.hpp"
#include "host/robot/motion/drive.hpp"
#include "host/simulation/robot/in_process.hpp"

namespace astro::support {
namespace {

namespace msg = ros2::msg;
using namespace std::chrono_literals;

constexpr double kPi = std::numbers::pi;
constexpr std::int64_t kEpoch_ns = 1'790'000'000'000'000'000;  // when this robot's clock was 0
constexpr std::int64_t kTransport_ns = 2'000'000;              // from a stamp to the recorder
constexpr int kWheelSample = 3;                                // of the telemetry's 100 per second: 33 Hz

/// A bag in either storage.
class BagOut {
 public:
  explicit BagOut(const std::filesystem::path& path) {
    if (path.extension() != ".mcap") {
      folder_.emplace(path);
      return;
    }
    file_.emplace(path);
    mcap_.emplace([this](ByteView bytes) { file_->write(bytes); }, bag::mcap::Header{"ros2", "tests"});
  }

  template <ros2::Message M>
  int add(const std::string& topic,
          bag::Db3Writer::Durability durability = bag::Db3Writer::Durability::volatile_) {
    const ros2::RosType type = ros2::ros_type<M>();
    if (folder_) return folder_->add_topic(topic, type.name, type.definition, durability);
    return mcap_->add_channel(mcap_->add_schema(type.name, "ros2msg", type.definition), topic, "cdr",
                              {{"offered_qos_profiles", ""}});
  }
  template <ros2::Message M>
  void write(int topic, std::int64_t stamp_ns, const M& message) {
    const Bytes bytes = ros2::encode(message);
    const std::int64_t time_ns = stamp_ns + kTransport_ns;
    if (folder_) return folder_->write(topic, time_ns, bytes);
    mcap_->write(static_cast<std::uint16_t>(topic), static_cast<std::uint64_t>(time_ns), bytes);
  }
  void close() {
    if (folder_) return folder_->close();
    mcap_->close();
    file_->commit();
  }

 private:
  std::optional<bag::Db3Writer> folder_;
  std::optional<PartFile> file_;
  std::optional<bag::McapWriter> mcap_;
};

std::int64_t stamp_of(double time_us) { return kEpoch_ns + std::llround(1000 * time_us); }

msg::TransformStamped fixed(const std::string& parent, const std::string& child, const Pose2& pose,
                            bool flipped = false) {
  msg::TransformStamped transform{{msg::to_time(kEpoch_ns), parent}, child, {}};
  transform.transform.translation = {pose.x_m, pose.y_m, 0.1};
  transform.transform.rotation = ros2::planar_pose(0, 0, pose.theta_rad).orientation;
  if (flipped) {  // about z, then half a turn about the new x: (x, y, z, w) of the product of both quaternions
    const msg::Quaternion turn = transform.transform.rotation;
    transform.transform.rotation = {turn.w, turn.z, 0, 0};
  }
  return transform;
}

/// Writes what the robot's programs would publish, as the robot drives.
class TurtleBot {
 public:
  TurtleBot(const BagDrive& drive, simulation::VirtualRobot& robot, BagOut& out)
      : drive_(drive), robot_(robot), out_(out), random_(drive.seed) {
    scan_ = out_.add<msg::LaserScan>("/scan");
    imu_ = out_.add<msg::Imu>("/imu");
    static_ = out_.add<msg::TFMessage>("/tf_static", bag::Db3Writer::Durability::latched);
    if (drive_.has_joint_states) joints_ = out_.add<msg::JointState>("/joint_states");
    if (drive_.has_odometry) odometry_ = out_.add<msg::Odometry>("/odom");
    out_.write(
        static_, kEpoch_ns,
        msg::TFMessage{{fixed("base_footprint", "base_link", {}), fixed("base_link", "imu_link", {}),
                        fixed("base_link", "base_scan", drive_.stated_mount, drive_.scanner.upside_down)}});
  }

  /// To be called for each sample of the telemetry.
  void publish(const recording::OdometrySample& sample) {
    headings_.push_back(robot_.board().truth().theta_rad);
    if (headings_.size() > kMostHeadings) headings_.pop_front();
    publish_imu(sample.time_us);
    publish_scans();
    if (count_++ % kWheelSample == 0) publish_wheels(sample);
  }

 private:
  static constexpr std::size_t kMostHeadings = 101;  // a second, the longest lag
  static constexpr double kPeriod_s = 0.01;

  double nominal_rad_per_count() const {
    return 2 * kPi / (drive_.robot.counts_per_motor_rev * drive_.robot.gear_ratio);
  }

  void publish_imu(std::int64_t time_us) {
    due_imu_s_ += kPeriod_s * drive_.gyro.rate_hz;
    const auto lag = static_cast<std::size_t>(std::lround(drive_.gyro.lag_s / kPeriod_s));
    if (due_imu_s_ < 1 || headings_.size() < lag + 2) return;
    due_imu_s_ -= 1;
    const auto newest = headings_.rbegin() + static_cast<std::ptrdiff_t>(lag);
    const double rate_radps = (*newest - *(newest + 1)) / kPeriod_s;
    msg::Imu message;
    message.header = {msg::to_time(stamp_of(static_cast<double>(time_us))), "imu_link"};
    message.orientation_covariance[0] = -1;
    message.angular_velocity.z = (1 + drive_.gyro.scale) * rate_radps + drive_.gyro.bias_radps +
                                 drive_.gyro.noise_radps * normal_(random_);
    message.angular_velocity_covariance[8] = drive_.gyro.noise_radps * drive_.gyro.noise_radps;
    message.linear_acceleration.z = 9.81;
    out_.write(imu_, stamp_of(static_cast<double>(time_us)), message);
  }

  void publish_scans() {
    for (const lidar::Scan& scan : robot_.scanner()->take_scans()) {
      const std::int64_t stamp_ns = kEpoch_ns + scan.time_ns + std::llround(1e9 * drive_.scans_late_s);
      const auto beams = static_cast<double>(scan.ranges_m.size());
      out_.write(scan_, stamp_ns,
                 msg::LaserScan{{msg::to_time(stamp_ns), "base_scan"},
                                static_cast<float>(scan.first_angle_rad),
                                static_cast<float>(scan.first_angle_rad + (beams - 1) * scan.angle_step_rad),
                                static_cast<float>(scan.angle_step_rad),
                                static_cast<float>(scan.beam_interval_s),
                                static_cast<float>(beams * scan.beam_interval_s),
                                static_cast<float>(scan.range_min_m),
                                static_cast<float>(scan.range_max_m),
                                scan.ranges_m,
                                {}});
    }
  }

  void publish_wheels(const recording::OdometrySample& sample) {
    const double left_rad = nominal_rad_per_count() * sample.left_counts,
                 right_rad = nominal_rad_per_count() * sample.right_counts;
    const std::int64_t stamp_ns = stamp_of(static_cast<double>(sample.time_us));
    if (joints_)
      out_.write(*joints_, stamp_ns,
                 msg::JointState{{msg::to_time(stamp_ns), ""},
                                 {"wheel_left_joint", "wheel_right_joint"},
                                 {left_rad, right_rad},
                                 {},
                                 {}});
    if (!odometry_) return;
    dead_reckon(left_rad, right_rad);
    msg::Odometry message{{msg::to_time(stamp_ns), "odom"}, "base_footprint", {}, {}};
    message.pose.pose = ros2::planar_pose(odom_.x_m, odom_.y_m, odom_.theta_rad);
    message.twist.twist.linear.x = sample.v_mps;
    message.twist.twist.angular.z = sample.omega_radps;
    out_.write(*odometry_, stamp_ns, message);
  }

  void dead_reckon(double left_rad, double right_rad) {
    const double radius_m = drive_.robot.nominal_diameter_m / 2;
    const double left_m = radius_m * (left_rad - std::exchange(left_rad_, left_rad)),
                 right_m = radius_m * (right_rad - std::exchange(right_rad_, right_rad));
    odom_ = odom_ *
            Twist2{(left_m + right_m) / 2, 0, (right_m - left_m) / drive_.robot.nominal_wheelbase_m}.exp();
  }

  const BagDrive& drive_;
  simulation::VirtualRobot& robot_;
  BagOut& out_;
  std::mt19937_64 random_;
  simulation::NormalDeviates normal_;
  int scan_ = 0, imu_ = 0, static_ = 0, count_ = 0;
  std::optional<int> joints_, odometry_;
  double due_imu_s_ = 0, left_rad_ = 0, right_rad_ = 0;
  std::deque<double> headings_;
  Pose2 odom_;
};

}  // namespace

void record_bag(const BagDrive& drive, const std::filesystem::path& path) {
  const auto robot = std::make_shared<simulation::VirtualRobot>(drive.robot, simulation::MocapConfig{},
                                                                drive.room, drive.scanner);
  robot::Client client(std::make_unique<simulation::InProcessTransport>(robot));
  client.connect();
  client.pump(50ms);  // through boot
  BagOut out(path);
  TurtleBot turtle(drive, *robot, out);
  robot->scanner()->take_scans();
  const auto subscription = client.on<protocol::Telemetry>(
      [&](const protocol::Telemetry& telemetry) { turtle.publish(recording::to_sample(telemetry)); });
  client.request(protocol::SetTelemetry{
      10, protocol::Telemetry::kPose | protocol::Telemetry::kCounts | protocol::Telemetry::kTwist});
  client.pump(1s);
  robot::DriveSession session(client);
  session.run(drive.path);
  session.pump(1s);
  session.end();
  out.close();
}

robot::Path calibration_drive(double side_m, int squares_each_way) {
  constexpr robot::PathLimits kLimits{0.3, 1.0};
  robot::Path path;
  const auto append = [&](const robot::Path& part) { path.insert(path.end(), part.begin(), part.end()); };
  for (const Sense sense : {Sense::ccw, Sense::cw}) {
    for (int i = 0; i < squares_each_way; ++i) append(robot::square(side_m, sense, kLimits));
    append(robot::circle(side_m / 3, 2, sense, kLimits));
    append(robot::spin(sense == Sense::ccw ? 2 : -2, kLimits));
  }
  return path;
}

}  // namespace astro::support
