#include "host/formats/messages/joint_state.hpp"

#include "host/formats/cdr/cdr.hpp"
#include "host/formats/cdr/codec.hpp"
#include "host/formats/messages/sensors.hpp"

namespace astro::ros2 {
namespace {

/// Whether the list is empty or has one number for each joint.
bool take_list(CdrReader& in, std::size_t joints, std::vector<double>& list) {
  const std::size_t count = in.length(sizeof(double));
  if (count != 0 && count != joints) return false;
  list.resize(count);
  for (double& value : list) value = in.number<double>();
  return in.ok();
}

}  // namespace

const RosType& joint_state_type() {
  static const RosType type = ros_type<msg::JointState>();
  return type;
}

Bytes encode_joint_state(const JointState& state) {
  return encode(msg::JointState{
      {msg::to_time(state.time_ns), ""}, state.names, state.positions, state.velocities, state.efforts});
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
