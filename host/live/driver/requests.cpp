#include "host/live/driver/requests.hpp"

#include <cmath>

#include "host/base/error.hpp"
#include "host/calibration/likelihood/matrix3.hpp"
#include "host/formats/cdr/codec.hpp"
#include "host/formats/messages/ros_messages.hpp"

namespace astro::live {

using calibration::Symmetric3;

namespace {

struct UncertainPose {
  Pose2 pose;
  Symmetric3 covariance;
};

Symmetric3 on_floor(const std::array<double, 36>& c) { return {c[0], c[1], c[5], c[7], c[11], c[35]}; }

/// Whether no direction has a negative variance: no principal minor may be negative beyond rounding.
bool is_covariance(const Symmetric3& p) {
  const auto minor = [](double a, double b, double ab) { return a * b * (1 + 1e-9) >= ab * ab; };
  return p.xx >= 0 && p.yy >= 0 && p.tt >= 0 && minor(p.xx, p.yy, p.xy) && minor(p.xx, p.tt, p.xt) &&
         minor(p.yy, p.tt, p.yt) && determinant(p) >= -1e-9 * p.xx * p.yy * p.tt;
}

/// The pose on the floor that a message sets. Throws astro::Error if there is no message, or if it is in another frame than
/// `frame`, holds NaN or infinity, an orientation of length 0, or an impossible covariance of (x, y, yaw).
UncertainPose planar(const std::optional<ros2::msg::PoseWithCovarianceStamped>& message,
                     const std::string& frame) {
  if (!message) throw Error("the message is damaged");
  if (message->header.frame_id != frame)
    throw Error("it is in the frame '" + message->header.frame_id + "', not in '" + frame + "'");
  const ros2::msg::Quaternion& q = message->pose.pose.orientation;
  const double length = std::hypot(std::hypot(q.x, q.y), std::hypot(q.z, q.w));
  const ros2::msg::Point& at = message->pose.pose.position;
  if (!std::isfinite(at.x) || !std::isfinite(at.y) || !std::isfinite(length))
    throw Error("it holds NaN or infinity");
  if (length < 1e-3) throw Error("its orientation has the length 0");
  const Symmetric3 covariance = on_floor(message->pose.covariance);
  // Written so that NaN is refused, too.
  if (!is_covariance(covariance)) throw Error("its covariance of x, y and yaw is not one");
  return {{at.x, at.y, ros2::heading_of(q)}, covariance};
}

}  // namespace

Requests::Requests(std::span<Middleware* const> middlewares, const Names& names, CommandType velocities,
                   Robot robot)
    : middlewares_(middlewares), names_(names), robot_(std::move(robot)) {
  subscribe_to_velocities(velocities);
  for (Middleware* each : middlewares_)
    subscribe<ros2::msg::PoseWithCovarianceStamped>(*each, "set_pose", 10, true,
                                                    [this](const auto& pose) { set_pose(pose); });
  serve_all();
}

void Requests::serve_all() {
  serve("arm", [this](RobotSession& session) {
    if (!session.knows_parameters() || !robot_.odometry.is_settled())
      throw Error(
          "the robot was found just now, and its parameters and its pose are not known yet: call again");
    return robot_.driving.arm(session);
  });
  serve("disarm", [this](RobotSession& session) { return robot_.driving.disarm(session), "disarmed"; });
  serve("stop", [this](RobotSession& session) { return robot_.driving.stop(session); });
  serve("emergency_stop", [this](RobotSession& session) {
    robot_.driving.release();
    session.ask(protocol::EmergencyStop{});
    return "the motors are off";
  });
  serve("clear_faults",
        [](RobotSession& session) { return session.ask(protocol::ClearFaults{}), "cleared"; });
  serve("pause", [this](RobotSession& session) { return robot_.driving.pause(session), "paused"; });
  serve("resume", [this](RobotSession& session) { return robot_.driving.resume(session); });
  serve("reset_odometry", [this](RobotSession& session) {
    robot_.odometry.set_pose(session, {}, {});
    return "the pose is zero";
  });
}

void Requests::serve(std::string_view name, Work work) {
  using Trigger = ros2::msg::Trigger;
  const ServiceDescription service{names_.absolute(name), Trigger::kType, message_type<Trigger::Request>(),
                                   message_type<Trigger::Response>(), name == "emergency_stop"};
  const auto answer = [this, work = std::move(work)](ByteView request) -> std::optional<Bytes> {
    if (!ros2::decode<Trigger::Request>(request)) return std::nullopt;
    return ros2::encode(attempt(work));
  };
  for (Middleware* each : middlewares_) each->serve(service, answer);
}

ros2::msg::Trigger::Response Requests::attempt(const Work& work) {
  RobotSession* session = robot_.link.session();
  if (session == nullptr) return {false, "there is no robot: " + robot_.words(robot_.link.why())};
  try {
    return {true, work(*session)};
  } catch (const robot::LinkLost& error) {
    robot_.lose(error);
    return {false, robot_.words(error)};
  } catch (const Error& error) {
    return {false, robot_.words(error)};
  }
}

template <ros2::Message M, class Take>
void Requests::subscribe(Middleware& middleware, std::string_view name, int depth, bool reliable, Take take) {
  middleware.subscribe({names_.absolute(name), message_type<M>(), reliable, false, depth},
                       [take](ByteView bytes) { take(ros2::decode<M>(bytes)); });
}

/// Subscribes with best effort, which publishers of either reliability serve: a lost velocity must not be sent again, because
/// it would come late, after a newer one.
void Requests::subscribe_to_velocities(CommandType type) {
  const auto take_velocity = [this](const auto& twist) { robot_.driving.take(twist, robot_.now()); };
  for (Middleware* each : middlewares_) {
    const CommandType taken = each->types_may_share_a_name() ? CommandType::both : type;
    if (taken != CommandType::twist_stamped)
      subscribe<ros2::msg::Twist>(*each, "cmd_vel", 1, false, take_velocity);
    if (taken != CommandType::twist)
      subscribe<ros2::msg::TwistStamped>(*each, "cmd_vel", 1, false, take_velocity);
  }
}

void Requests::set_pose(const std::optional<ros2::msg::PoseWithCovarianceStamped>& message) {
  const auto outcome = attempt([&](RobotSession& session) {
    const auto [pose, covariance] = planar(message, names_.odom_frame());
    robot_.odometry.set_pose(session, pose, covariance);
    return "set";
  });
  if (outcome.success) return;
  constexpr microseconds kSameAgain = std::chrono::seconds(10);  // a repeated refusal is reported once
  const microseconds now = robot_.now().steady;
  const auto last = robot_.odometry.refused_pose();
  robot_.odometry.refuse({outcome.message, now});
  if (!last || last->why != outcome.message || now - last->at > kSameAgain)
    robot_.notice("a pose was not set: " + outcome.message);
}

}  // namespace astro::live
