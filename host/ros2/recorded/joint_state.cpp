#include "host/ros2/joint_state.hpp"

#include "host/ros2/cdr.hpp"
#include "host/ros2/message_definitions.hpp"
#include "host/ros2/ros_stamp.hpp"

namespace astro::ros2 {
namespace {

constexpr RosType kJointStateType{
    "sensor_msgs/msg/JointState",
    "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\n"
    "float64[] effort\n" ASTRO_MSG_HEADER};

void put_list(CdrWriter& out, const std::vector<double>& list) {
  out.number(static_cast<std::uint32_t>(list.size()));
  for (const double value : list) out.number(value);
}

/// Whether the list is empty or has one number for each joint.
bool take_list(CdrReader& in, std::size_t joints, std::vector<double>& list) {
  const std::size_t count = in.length(sizeof(double));
  if (count != 0 && count != joints) return false;
  list.resize(count);
  for (double& value : list) value = in.number<double>();
  return in.ok();
}

}  // namespace

const RosType& joint_state_type() { return kJointStateType; }

Bytes encode_joint_state(const JointState& state) {
  CdrWriter out;
  put_time_ns(out, state.time_ns);
  out.string("");
  out.number(static_cast<std::uint32_t>(state.names.size()));
  for (const std::string& name : state.names) out.string(name);
  for (const auto* list : {&state.positions, &state.velocities, &state.efforts}) put_list(out, *list);
  return out.bytes();
}

std::optional<JointState> decode_joint_state(ByteView message) {
  CdrReader in(message);
  JointState state;
  state.time_ns = take_time_ns(in);
  in.string();
  const std::size_t joints = in.length(sizeof(std::uint32_t));
  if (!in.ok() || joints > kMostJoints) return std::nullopt;
  state.names.resize(joints);
  for (std::string& name : state.names) name = in.name();
  for (auto* list : {&state.positions, &state.velocities, &state.efforts})
    if (!take_list(in, joints, *list)) return std::nullopt;
  return state;
}

}  // namespace astro::ros2
