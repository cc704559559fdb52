#include "host/commands/simulate/ros_pose_publisher.hpp"

#include "host/base/blocked_signals.hpp"
#include "host/formats/cdr/codec.hpp"
#include "host/formats/cdr/names.hpp"
#include "host/formats/cdr/type_description.hpp"
#include "host/formats/messages/geometry.hpp"
#include "host/formats/messages/nodes.hpp"
#include "host/live/dds/fast_dds.hpp"

namespace astro::commands {
namespace {

namespace msg = ros2::msg;

constexpr std::int64_t kNanosPerMicro = 1000;
constexpr dds::Qos kReliable{true, false, 10}, kLatched{true, true, 1};

}  // namespace

RosPosePublisher::RosPosePublisher(const std::string& topic, const dds::Discovery& discovery) {
  using Info = msg::ParticipantEntitiesInfo<msg::kGidBytes>;
  const BlockedSignals blocked;
  participant_ = dds::open_fast_dds(discovery, "virtual_tracker", "enclave=/;");
  nodes_ = participant_->create_writer({"ros_discovery_info", ros2::dds_type_name(Info::kType), kLatched});
  poses_ = participant_->create_writer({ros2::wire_name_of_topic(topic),
                                        ros2::dds_type_name(msg::PoseStamped::kType), kReliable,
                                        "typehash=" + ros2::hash_of<msg::PoseStamped>() + ";"});
  nodes_->write(ros2::encode(
      Info{{participant_->guid().bytes}, {{{"/"}, {"virtual_tracker"}, {}, {{poses_->guid().bytes}}}}}));
}

void RosPosePublisher::send(const simulation::TrackedFrame& frame) {
  const truth::Pose3& p = frame.pose;
  poses_->write(ros2::encode(msg::PoseStamped{{msg::to_time(kNanosPerMicro * frame.exposed_us), "world"},
                                              {{p.x_m, p.y_m, p.z_m}, {p.qx, p.qy, p.qz, p.qw}}}));
}

}  // namespace astro::commands
