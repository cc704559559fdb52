#include "host/recording/rosbag_export.hpp"

#include "host/base/error.hpp"
#include "host/formats/files/db3_writer.hpp"
#include "host/formats/messages/joint_state.hpp"
#include "host/formats/messages/ros_messages.hpp"
#include "host/formats/messages/stamped_pose.hpp"
#include "host/formats/messages/text_message.hpp"
#include "host/recording/log_time.hpp"
#include "host/recording/robot_messages.hpp"
#include "host/recording/run_order.hpp"
#include "host/recording/sample_messages.hpp"

namespace astro::recording {
namespace {

class Exporter {
 public:
  Exporter(const Run& run, const std::filesystem::path& folder)
      : bag_(folder), robot_(run.info), log_time_(folder, run.info.started_at) {
    odometry_ = add("/odom", ros2::odometry_type());
    counts_ = add("/wheel_counts", recording::wheel_counts_type());
    truth_ = add("/truth", ros2::pose_stamped_type());
    transforms_ = add("/tf", ros2::tf_message_type());
    if (!run.gyro.empty()) gyro_poses_ = add("/odom_gyro", ros2::odometry_type());
    if (!run.slips.empty()) slips_ = add("/gyro_slip", recording::gyro_slip_type());
    if (!run.scans.empty()) scans_ = add("/scan", recording::laser_scan_type());
    if (!robot_.knows_sizes()) return;
    joints_ = add("/joint_states", ros2::joint_state_type());
    description_ = bag_.add_topic("/robot_description", ros2::string_type().name,
                                  ros2::string_type().definition, bag::Db3Writer::Durability::latched);
  }

  void write(const OdometrySample& sample) {
    const std::int64_t time_ns = log_time_.ns(sample.time_us);
    describe(time_ns);
    robot_.advance(sample);
    bag_.write(odometry_, time_ns, recording::encode_odometry(sample));
    bag_.write(counts_, time_ns,
               recording::encode_counts({sample.time_us, sample.left_counts, sample.right_counts}));
    bag_.write(transforms_, time_ns, robot_.transforms());
    if (robot_.knows_sizes()) bag_.write(joints_, time_ns, robot_.joints());
  }
  void write(const TruthSample& sample) {
    const std::int64_t time_ns = log_time_.ns(sample.time_us);
    describe(time_ns);
    bag_.write(truth_, time_ns, recording::encode_truth(sample));
  }
  void write(const GyroPose& pose) {
    const std::int64_t time_ns = log_time_.ns(pose.time_us);
    describe(time_ns);
    bag_.write(gyro_poses_, time_ns, recording::encode_gyro_pose(pose));
  }
  void write(const GyroSlip& slip) {
    const std::int64_t time_ns = log_time_.ns(slip.time_us);
    describe(time_ns);
    bag_.write(slips_, time_ns, recording::encode_slip(slip));
  }
  void write(const lidar::Scan& scan) {
    const std::int64_t time_ns = log_time_.ns(scan.time_ns / 1000);
    describe(time_ns);
    bag_.write(scans_, time_ns, recording::encode_scan(scan));
  }
  void close() { bag_.close(); }

 private:
  int add(const char* name, const ros2::RosType& type) {
    return bag_.add_topic(name, type.name, type.definition);
  }

  /// Writes the first message of the bag.
  void describe(std::int64_t time_ns) {
    if (robot_.knows_sizes() && !described_) bag_.write(description_, time_ns, robot_.description());
    described_ = true;
  }

  bag::Db3Writer bag_;
  RobotMessages robot_;
  LogTime log_time_;
  bool described_ = false;
  int odometry_ = 0, counts_ = 0, truth_ = 0, transforms_ = 0, joints_ = 0, description_ = 0, scans_ = 0;
  int gyro_poses_ = 0, slips_ = 0;
};

}  // namespace

void export_rosbag(const Run& run, const std::filesystem::path& folder) {
  Exporter exporter(run, folder);
  for_each_in_order(run, [&](const auto& sample) { exporter.write(sample); });
  exporter.close();
}

}  // namespace astro::recording
