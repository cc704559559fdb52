#include "firmware/app/hosts/snapshot.hpp"

namespace astro {

protocol::Telemetry snapshot(const Drive& drive, std::uint64_t time_us, std::int32_t battery_mv) {
  const Pose& pose = drive.pose();
  const Wheels& wheels = drive.wheels();
  const BodyTwist twist = drive.twist();
  protocol::Telemetry telemetry;
  telemetry.device_time_us = time_us;
  telemetry.pose = {pose.x, pose.y, pose.theta.raw(), pose.turns};
  telemetry.counts = {wheels.left_counts(), wheels.right_counts()};
  telemetry.twist = {twist.v_umps, twist.omega_uradps};
  telemetry.wheel_speed = {wheels.speeds().left_umps, wheels.speeds().right_umps};
  telemetry.setpoint = {wheels.set_points().left_umps, wheels.set_points().right_umps};
  telemetry.duty = {wheels.forward_duty().left, wheels.forward_duty().right};
  telemetry.battery = {battery_mv};
  telemetry.state = {drive.mode(), drive.running_tag(), drive.faults().mask()};
  const PathFollower& follower = drive.follower();
  telemetry.path = {drive.running_tag(), static_cast<std::uint16_t>(follower.profile().progress_16() / 2),
                    static_cast<std::uint16_t>(drive.queued()), follower.cross_track_um(),
                    follower.heading_error_urad()};
  return telemetry;
}

}  // namespace astro
