#include "host/truth/floor/up_axis.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "host/truth/files/rotations.hpp"

namespace astro::truth {
namespace {

using Solver = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;

Direction3 upwards(const Eigen::Vector3d& v) {
  Eigen::Index largest = 0;
  v.cwiseAbs().maxCoeff(&largest);
  const Eigen::Vector3d up = v[largest] < 0 ? Eigen::Vector3d(-v) : v;
  return {up[0], up[1], up[2]};
}

/// A drive is curved enough to define a plane if the plane's second extent is at least a thirtieth of the first and
/// ten times the distances from the plane.
void judge_positions(const BodyTrack& track, UpAxisEvidence& out) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double count = 0;
  for (const TrackedPose& s : track.samples) {
    if (!s.valid) continue;
    mean += Eigen::Vector3d(s.pose.x_m, s.pose.y_m, s.pose.z_m);
    ++count;
  }
  if (count < 3) return;
  mean /= count;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const TrackedPose& s : track.samples) {
    if (!s.valid) continue;
    const Eigen::Vector3d d = Eigen::Vector3d(s.pose.x_m, s.pose.y_m, s.pose.z_m) - mean;
    scatter += d * d.transpose();
  }
  const Solver solver(scatter / count);
  const Eigen::Vector3d extent = solver.eigenvalues().cwiseMax(0).cwiseSqrt();  // the smallest first
  out.plane_rms_m = extent[0];
  if (extent[1] > 10 * extent[0] && extent[1] > extent[2] / 30)
    out.by_positions = upwards(solver.eigenvectors().col(0));
}

/// The vector part of a quaternion points along the axis, and is as long as the sine of half the angle.
void judge_rotations(const BodyTrack& track, UpAxisEvidence& out) {
  constexpr double kSmallestTurn_rad = 0.2;
  const auto& samples = track.samples;
  const auto first = std::find_if(samples.begin(), samples.end(), [](const auto& s) { return s.valid; });
  if (first == samples.end() || track.facts.rotation_kind == RotationKind::none) return;
  const Quaternion start = conjugate(rotation_of(first->pose));
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  double count = 0;
  for (auto s = first; s != samples.end(); ++s) {
    if (!s->valid) continue;
    const Quaternion q = rotation_of(s->pose) * start;
    const Eigen::Vector3d v(q.x, q.y, q.z);
    scatter += v * v.transpose();
    ++count;
  }
  const Solver solver(scatter / count);
  const Eigen::Vector3d extent = solver.eigenvalues().cwiseMax(0).cwiseSqrt();
  if (2 * extent[2] > kSmallestTurn_rad && extent[2] > 5 * extent[1])
    out.by_rotations = upwards(solver.eigenvectors().col(2));
}

}  // namespace

std::string axis_text(const Direction3& direction) {
  constexpr double kAlong = 0.999;  // 2.6 degrees
  for (std::size_t i = 0; i < 3; ++i)
    if (std::abs(direction[i]) > kAlong) return std::string(direction[i] < 0 ? "-" : "") + "xyz"[i];
  return fmt::format("{:.2f},{:.2f},{:.2f}", direction[0], direction[1], direction[2]);
}

UpAxisEvidence find_up_axis(const BodyTrack& track) {
  UpAxisEvidence out;
  judge_positions(track, out);
  judge_rotations(track, out);
  if (out.by_positions && out.by_rotations) {
    const Direction3 &a = *out.by_positions, &b = *out.by_rotations;
    const double cosine = std::abs(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
    out.disagreement_rad = std::acos(std::min(1.0, cosine));
  }
  return out;
}

}  // namespace astro::truth
