#include "host/truth/trackers/frame_tree.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/base/error.hpp"

namespace astro::truth {
namespace {

constexpr std::size_t kMostFrames = 4096;
constexpr std::size_t kLongestChain = 64;  // this also ends a cycle

struct Vector {
  double x = 0, y = 0, z = 0;
};

Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace

/// v' = v + 2 q x (q x v + w v), and Hamilton's product of the rotations.
Pose3 composed(const Pose3& outer, const Pose3& inner) {
  const double length = std::hypot(std::hypot(outer.qx, outer.qy), std::hypot(outer.qz, outer.qw));
  const Vector q{outer.qx / length, outer.qy / length, outer.qz / length};
  const double w = outer.qw / length;
  const Vector v{inner.x_m, inner.y_m, inner.z_m}, p{inner.qx, inner.qy, inner.qz};
  const Vector once = cross(q, v);
  const Vector twice = cross(q, {once.x + w * v.x, once.y + w * v.y, once.z + w * v.z});
  const Vector both = cross(q, p);
  return {outer.x_m + v.x + 2 * twice.x,
          outer.y_m + v.y + 2 * twice.y,
          outer.z_m + v.z + 2 * twice.z,
          w * p.x + inner.qw * q.x + both.x,
          w * p.y + inner.qw * q.y + both.y,
          w * p.z + inner.qw * q.z + both.z,
          w * inner.qw - q.x * p.x - q.y * p.y - q.z * p.z};
}

std::string plain_frame(std::string_view name) {
  if (name.starts_with('/')) name.remove_prefix(1);
  return std::string(name);
}

void FrameTree::put(const ros2::StampedPose& transform, bool fixed) {
  const std::string child = plain_frame(transform.child_frame);
  const Pose3 pose{transform.x_m, transform.y_m, transform.z_m, transform.qx,
                   transform.qy,  transform.qz,  transform.qw};
  const auto known = transforms_.find(child);
  if (known == transforms_.end()) {
    if (transforms_.size() < kMostFrames)
      transforms_[child] = {plain_frame(transform.frame), pose, fixed, false};
    return;
  }
  Transform& at = known->second;
  at.moved = !fixed && (at.moved || (!at.fixed && at.pose != pose));
  at.parent = plain_frame(transform.frame);
  at.pose = pose;
  at.fixed = fixed;
}

std::vector<std::string> FrameTree::chain(const std::string& child, const std::string& parent) const {
  std::vector<std::string> frames{child};
  const auto ends = [&] { return parent.empty() ? frames.size() == 2 : frames.back() == parent; };
  while (!ends() && frames.size() < kLongestChain) {
    const auto above = transforms_.find(frames.back());
    if (above == transforms_.end()) break;
    frames.push_back(above->second.parent);
  }
  return frames;
}

std::optional<std::string> FrameTree::moving(const std::vector<std::string>& chain) const {
  std::optional<std::string> topmost, moved;
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    const Transform& at = transforms_.at(chain[i]);
    if (!at.fixed) topmost = chain[i];
    if (!at.moved) continue;
    if (moved)
      throw Error(fmt::format("from '{}' to '{}' two transforms move, those of '{}' and '{}', and a tracker "
                              "measures only one",
                              chain.back(), chain.front(), *moved, chain[i]),
                  FrameProblem::two_move, {chain.back(), chain.front(), *moved, chain[i]});
    moved = chain[i];
  }
  return moved ? moved : topmost;
}

Pose3 FrameTree::pose(const std::vector<std::string>& chain) const {
  Pose3 pose = transforms_.at(chain.front()).pose;
  for (std::size_t i = 1; i + 1 < chain.size(); ++i) pose = composed(transforms_.at(chain[i]).pose, pose);
  return pose;
}

}  // namespace astro::truth
