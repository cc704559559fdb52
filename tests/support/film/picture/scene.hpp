#pragma once

#include <optional>
#include <vector>

#include "tests/support/film/picture/patch.hpp"
#include "tests/support/film/picture/pose_track.hpp"

/// What is before the camera.
namespace astro::support::film {

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
