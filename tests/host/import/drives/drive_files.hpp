#pragma once

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <string>

#include "host/calibration/motion/trajectory.hpp"
#include "host/formats/cdr/cdr.hpp"
#include "host/formats/files/db3_writer.hpp"
#include "host/formats/messages/joint_state.hpp"
#include "host/formats/messages/text_message.hpp"

/// Writes a drive as other programs do: wheels as counts, angles or metres, truth as the trackers' formats.
namespace astro::test {

namespace fs = std::filesystem;

inline constexpr double kDiameter_m = 0.084, kCountsPerTurn = 4096, kHeight_m = 0.21;
inline constexpr double kMetresPerCount = std::numbers::pi * kDiameter_m / kCountsPerTurn;

/// A pose of a body on a robot: the height is that of the body above the floor.
struct BodyPose {
  double x, y, z, qx, qy, qz, qw;
};

/// How a tracker sees the world: from a pose whose z axis points up.
using Frame = std::function<BodyPose(BodyPose)>;

inline BodyPose z_up(BodyPose pose) { return pose; }
/// As Motive: x to the left of z, y up. A turn of the axes: x' = y, y' = z, z' = x.
inline BodyPose y_up(BodyPose p) { return {p.y, p.z, p.x, p.qy, p.qz, p.qx, p.qw}; }
/// As in flight: x ahead, y to the right, z down.
inline BodyPose z_down(BodyPose p) { return {p.x, -p.y, -p.z, p.qx, -p.qy, -p.qz, p.qw}; }

inline BodyPose pose_of(const calibration::BodySample& sample, double height_m = kHeight_m) {
  return {
      sample.x_m, sample.y_m, height_m, 0, 0, std::sin(sample.theta_rad / 2), std::cos(sample.theta_rad / 2)};
}

inline void write_lines(const fs::path& path, const std::string& head, const auto& rows, const auto& line) {
  std::ofstream file(path);
  file << head;
  for (const auto& row : rows) file << line(row) << '\n';
}

inline fs::path write_counts(const fs::path& path, const calibration::Trajectory& run, double start_s = 0) {
  write_lines(path, "time_s,left_counts,right_counts\n", run.wheels, [&](const auto& at) {
    return fmt::format("{:.9f},{},{}", start_s + at.time_s, std::llround(at.left_m / kMetresPerCount),
                       std::llround(at.right_m / kMetresPerCount));
  });
  return path;
}

/// Without names, and each row the travel since the row before.
inline fs::path write_counts_per_interval(const fs::path& path, const calibration::Trajectory& run) {
  long left = 0, right = 0;
  write_lines(path, "", run.wheels, [&](const auto& at) {
    const long l = std::llround(at.left_m / kMetresPerCount), r = std::llround(at.right_m / kMetresPerCount);
    const std::string row = fmt::format("{:.9f};{};{}", at.time_s, r - right, l - left);
    left = l;
    right = r;
    return row;
  });
  return path;
}

inline fs::path write_degrees(const fs::path& path, const calibration::Trajectory& run) {
  constexpr double kDegrees = 360 / (std::numbers::pi * kDiameter_m);
  write_lines(path, "Time (ms)\tRight wheel [deg]\tLeft wheel [deg]\n", run.wheels, [&](const auto& at) {
    return fmt::format("{:.6f}\t{:.9f}\t{:.9f}", 1000 * at.time_s, kDegrees * at.right_m,
                       kDegrees * at.left_m);
  });
  return path;
}

inline fs::path write_metres(const fs::path& path, const calibration::Trajectory& run) {
  write_lines(path, "t_s left_m right_m\n", run.wheels, [&](const auto& at) {
    return fmt::format("{:.9f} {:.12f} {:.12f}", at.time_s, at.left_m, at.right_m);
  });
  return path;
}

inline fs::path write_tum(const fs::path& path, const calibration::Trajectory& run, const Frame& frame = z_up,
                          double start_s = 0, double height_m = kHeight_m) {
  write_lines(path, "# timestamp tx ty tz qx qy qz qw\n", run.truth, [&](const auto& at) {
    const BodyPose p = frame(pose_of(at, height_m));
    return fmt::format("{:.9f} {:.9f} {:.9f} {:.9f} {:.12f} {:.12f} {:.12f} {:.12f}", start_s + at.time_s,
                       p.x, p.y, p.z, p.qx, p.qy, p.qz, p.qw);
  });
  return path;
}

inline fs::path write_plain_millimetres(const fs::path& path, const calibration::Trajectory& run) {
  write_lines(path, "time_ms,x_mm,y_mm,yaw_deg\n", run.truth, [&](const auto& at) {
    return fmt::format("{:.6f},{:.6f},{:.6f},{:.10f}", 1000 * at.time_s, 1000 * at.x_m, 1000 * at.y_m,
                       at.theta_rad * 180 / std::numbers::pi);
  });
  return path;
}

inline fs::path write_motive(const fs::path& path, const calibration::Trajectory& run) {
  int frame = 0;
  write_lines(path,
              "Format Version,1.23,Take Name,drive,Capture Frame Rate,60.000000,Export Frame Rate,60.000000,"
              "Rotation Type,Quaternion,Length Units,Millimeters,Coordinate Space,Global\n\n"
              ",,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body\n"
              ",,ASTRO,ASTRO,ASTRO,ASTRO,ASTRO,ASTRO,ASTRO\n,,1,1,1,1,1,1,1\n"
              ",,Rotation,Rotation,Rotation,Rotation,Position,Position,Position\n"
              "Frame,Time (Seconds),X,Y,Z,W,X,Y,Z\n",
              run.truth, [&](const auto& at) {
                const BodyPose p = y_up(pose_of(at));
                return fmt::format("{},{:.6f},{:.12f},{:.12f},{:.12f},{:.12f},{:.6f},{:.6f},{:.6f}", frame++,
                                   at.time_s, p.qx, p.qy, p.qz, p.qw, 1000 * p.x, 1000 * p.y, 1000 * p.z);
              });
  return path;
}

inline Bytes pose_stamped(std::int64_t time_ns, const BodyPose& p) {
  ros2::CdrWriter out;
  out.number(static_cast<std::int32_t>(time_ns / 1'000'000'000));
  out.number(static_cast<std::uint32_t>(time_ns % 1'000'000'000));
  out.string("mocap");
  for (const double value : {p.x, p.y, p.z, p.qx, p.qy, p.qz, p.qw}) out.number(value);
  return out.bytes();
}

/// A folder as `ros2 bag record` makes it: /joint_states and /tracker/pose.
/// `urdf`: recorded as the robot's description unless it is "". `stamp`: what the wheels' clock shows at a time of theirs.
inline fs::path write_bag(
    const fs::path& folder, const calibration::Trajectory& run, const Frame& frame = z_up,
    const std::string& urdf = {},
    const std::function<double(double)>& stamp = [](double time_s) { return time_s; }) {
  constexpr std::int64_t kStart_ns = 1'700'000'000'000'000'000;
  const auto time_ns = [&](double s) { return kStart_ns + std::llround(1e9 * s); };
  bag::Db3Writer bag(folder);
  const int joints = bag.add_topic("/joint_states", "sensor_msgs/msg/JointState", "");
  const int poses = bag.add_topic("/tracker/pose", "geometry_msgs/msg/PoseStamped", "");
  if (!urdf.empty())
    bag.write(bag.add_topic("/robot_description", "std_msgs/msg/String", ""), time_ns(0),
              ros2::encode_text(urdf));
  for (const auto& at : run.wheels)
    bag.write(joints, time_ns(at.time_s),
              ros2::encode_joint_state({time_ns(stamp(at.time_s)),
                                        {"wheel_left_joint", "wheel_right_joint"},
                                        {2 * at.left_m / kDiameter_m, 2 * at.right_m / kDiameter_m},
                                        {},
                                        {}}));
  for (const auto& at : run.truth)
    bag.write(poses, time_ns(at.time_s), pose_stamped(time_ns(at.time_s), frame(pose_of(at))));
  bag.close();
  return folder;
}

}  // namespace astro::test
