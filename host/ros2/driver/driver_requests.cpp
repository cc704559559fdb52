#include "host/ros2/driver/driver.hpp"
#include "host/ros2/driver/pose_message.hpp"
#include "host/ros2/messages/services.hpp"

/// What others ask of the driver.
namespace astro::ros2 {

void Driver::serve_all() {
  serve("arm", [this](RobotSession& session) { return driving_.arm(session); });
  serve("disarm", [this](RobotSession& session) { return driving_.disarm(session), "disarmed"; });
  serve("stop", [this](RobotSession& session) { return driving_.stop(session), "ramps to rest"; });
  serve("emergency_stop", [this](RobotSession& session) {
    driving_.release();
    session.ask(protocol::EmergencyStop{});
    return "the motors are off";
  });
  serve("clear_faults",
        [](RobotSession& session) { return session.ask(protocol::ClearFaults{}), "cleared"; });
  serve("pause", [](RobotSession& session) { return session.ask(protocol::Pause{}), "paused"; });
  serve("resume", [](RobotSession& session) { return session.ask(protocol::Resume{}), "resumed"; });
  serve("reset_odometry", [this](RobotSession& session) {
    odometry_.set_pose(session, 0, 0, 0, {});
    return "the pose is zero";
  });
}

void Driver::serve(std::string_view name, Work work) {
  using Trigger = msg::Trigger;
  const ServiceDescription service{names_.absolute(name), Trigger::kType, message_type<Trigger::Request>(),
                                   message_type<Trigger::Response>()};
  const auto answer = [this, work = std::move(work)](ByteView request) -> std::optional<Bytes> {
    if (!decode<Trigger::Request>(request)) return std::nullopt;
    return encode(attempt(work));
  };
  for (Middleware* each : middlewares_) each->serve(service, answer);
}

msg::Trigger::Response Driver::attempt(const Work& work) {
  RobotSession* session = link_.session();
  if (session == nullptr) return {false, "there is no robot: " + options_.words(link_.why())};
  try {
    return {true, work(*session)};
  } catch (const robot::LinkLost& error) {
    lose(error);
    return {false, options_.words(error)};
  } catch (const Error& error) {
    return {false, options_.words(error)};
  }
}

template <Message M, class Take>
void Driver::subscribe_to(std::string_view name, int depth, bool reliable, Take take) {
  const TopicDescription topic{names_.absolute(name), message_type<M>(), reliable, false, depth};
  for (Middleware* each : middlewares_)
    each->subscribe(topic, [take](ByteView bytes) { take(decode<M>(bytes)); });
}

/// Velocities are taken as they come, from publishers of either kind: one that was lost is older than the next one, and must
/// not come late.
void Driver::subscribe() {
  subscribe_to<msg::Twist>("cmd_vel", 1, false,
                           [this](const auto& twist) { driving_.take(twist, moment()); });
  subscribe_to<msg::TwistStamped>("cmd_vel", 1, false,
                                  [this](const auto& twist) { driving_.take(twist, moment()); });
  subscribe_to<msg::PoseWithCovarianceStamped>("set_pose", 10, true,
                                               [this](const auto& pose) { set_pose(pose); });
}

void Driver::set_pose(const std::optional<msg::PoseWithCovarianceStamped>& message) {
  const auto outcome = attempt([&](RobotSession& session) {
    const PlanarPose pose = planar(message, names_.frame(kOdomFrame));
    odometry_.set_pose(session, pose.x_m, pose.y_m, pose.theta_rad, pose.covariance);
    return "set";
  });
  if (!outcome.success) odometry_.note("a pose was not set: " + outcome.message);
}

}  // namespace astro::ros2
