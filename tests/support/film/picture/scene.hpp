#pragma once

#include <Eigen/Core>

#include <array>
#include <optional>
#include <vector>

#include "host/film/picture/tag_picture.hpp"
#include "tests/support/film/picture/camera.hpp"
#include "tests/support/film/picture/pose_track.hpp"

/// What is before the camera.
namespace astro::support::film {

/// A tag on paper, seen in its own frame: x to the right of the upright tag, y to its top, the origin in its centre.
class TagPaper {
 public:
  /// `margin_cells` of white around the black square. `mirrored`: printed or shown the wrong way round.
  TagPaper(int id, double side_m, double margin_cells = 1, bool mirrored = false);

  int id() const { return id_; }
  double side_m() const { return side_m_; }
  double half_paper_m() const { return half_paper_m_; }
  bool black(float x_m, float y_m) const {
    const float column = (x_m * per_side_ + 0.5F) * static_cast<float>(::astro::film::paper::kCells);
    const float row = (0.5F - y_m * per_side_) * static_cast<float>(::astro::film::paper::kCells);
    constexpr float kEnd = ::astro::film::paper::kCells;
    if (!(column >= 0 && column < kEnd && row >= 0 && row < kEnd)) return false;
    return !white_[static_cast<std::size_t>(row) * ::astro::film::paper::kCells +
                   static_cast<std::size_t>(column)];
  }

 private:
  int id_;
  double side_m_, half_paper_m_;
  float per_side_;
  std::array<bool, static_cast<std::size_t>(::astro::film::paper::kCells* ::astro::film::paper::kCells)>
      white_{};
};

inline constexpr float kPaper = 0.80F, kInk = 0.035F;  // reflectance

/// A flat rectangle of grey or with a tag: what films are made of.
struct Patch {
  Eigen::Vector3d origin_m, x_axis, y_axis;  // axes of length 1 in the plane
  double x_from_m, x_to_m, y_from_m, y_to_m;
  float grey = 0.5F;
  const TagPaper* tag = nullptr;  // if there is one, the patch is its paper

  std::array<Eigen::Vector3d, 4> corners_m() const;
};

/// A tag's paper. The pose is that of its centre; it is tilted about its own x axis, then about its own y axis.
Patch tag_patch(const TagPaper& tag, double x_m, double y_m, double z_m, double yaw_rad,
                double tilt_x_rad = 0, double tilt_y_rad = 0);

/// A patch as a camera sees it: from rays to reflectance.
class PatchView {
 public:
  PatchView() = default;
  PatchView(const Patch& patch, const Camera& camera);

  /// The reflectance where the ray meets the patch; nothing if it does not, or from behind.
  bool hit(float x, float y, float& reflectance) const {
    const float w = m_[6] * x + m_[7] * y + m_[8];
    if (!(w > 0)) return false;
    const float a = m_[0] * x + m_[1] * y + m_[2], b = m_[3] * x + m_[4] * y + m_[5];
    if (a < x_from_ * w || a > x_to_ * w || b < y_from_ * w || b > y_to_ * w) return false;
    reflectance = grey_;
    if (tag_ != nullptr) reflectance = tag_->black(a / w, b / w) ? kInk : kPaper;
    return true;
  }

 private:
  std::array<float, 9> m_{};
  float x_from_ = 0, x_to_ = 0, y_from_ = 0, y_to_ = 0, grey_ = 0;
  const TagPaper* tag_ = nullptr;
};

/// A sheet on the floor, or nearly: paper bulges, floors are not flat.
struct FloorTag {
  TagPaper paper;
  FloorPose pose;
  double z_m = 0, tilt_x_rad = 0, tilt_y_rad = 0;

  Patch patch() const {
    return tag_patch(paper, pose.x_m, pose.y_m, z_m, pose.theta_rad, tilt_x_rad, tilt_y_rad);
  }
};

/// A box on wheels with a tag on a post above its lid.
struct FilmedRobot {
  PoseTrack track;  // of the point midway between the wheels, by the robot's clock
  TagPaper paper;
  FloorPose lever{0.020, -0.010, 0.05236};  // the tag's centre on the robot
  double height_m = 0.120, tilt_x_rad = 0, tilt_y_rad = 0;
  // The box, about the point between the wheels.
  double length_m = 0.325, width_m = 0.300, floor_gap_m = 0.03, lid_m = 0.10;

  FloorPose tag_at(double time_s) const { return compose(track.at(time_s), lever); }
  Patch tag_patch_at(double time_s) const;
  /// The tag first, then lid and sides.
  std::vector<Patch> patches_at(double time_s) const;
};

/// A person's leg that walks past: a cone from the foot to the hip, by the robot's clock.
struct Leg {
  double from_s, to_s;
  FloorPose from, to;  // of the foot
  double foot_radius_m = 0.05, hip_radius_m = 0.09, hip_m = 0.8;
};

struct Scene {
  std::vector<FloorTag> floor;
  std::vector<FilmedRobot> robots;
  std::vector<Leg> legs;
  float floor_grey = 0.40F, floor_contrast = 0.12F;  // mean reflectance; how much it varies
};

}  // namespace astro::support::film
