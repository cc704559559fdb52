#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "host/film/camera/camera.hpp"
#include "host/film/camera/floor_start.hpp"
#include "host/film/camera/planar_pose.hpp"
#include "host/film/camera/scene.hpp"
#include "tests/host/film/camera/synthetic_scene.hpp"

namespace astro::film {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

TEST(Camera, FindsThePlaceThatAPixelShows) {
  const Camera camera = support::phone_scene().camera;
  for (const double x : {-0.5, 0.0, 1.5})
    for (const double y : {0.0, 0.7}) {
      const auto back = on_plane(camera, project(camera, {x, y, 0.12}), 0.12);
      ASSERT_TRUE(back);
      EXPECT_NEAR((*back - Vector2d(x, y)).norm(), 0, 1e-12);  // both are exact: only rounding remains
    }
}

TEST(Camera, ShowsNoFloorAboveTheHorizon) {
  const Camera camera = support::phone_scene().camera;
  EXPECT_FALSE(on_plane(camera, {960, -3000}, 0));
}

TEST(EdgeShift, MovesEachEdgeByThatMuch) {
  const TagCorners corners{Vector2d(100, 150), {160, 148}, {155, 90}, {98, 95}};
  const TagCorners shifted = with_edges_shifted(corners, 0.4);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2d edge = (corners[(i + 1) % 4] - corners[i]).normalized();
    const Vector2d inward(edge.y(), -edge.x());
    EXPECT_NEAR(inward.dot(shifted[i] - corners[i]), 0.4, 1e-12);
    EXPECT_NEAR(inward.dot(shifted[(i + 1) % 4] - corners[(i + 1) % 4]), 0.4, 1e-12);
  }
}

TEST(PlanarPose, IsOneOfTheTwoThatAreFound) {
  const Eigen::Matrix3d rotation =
      (Eigen::AngleAxisd(2.4, Vector3d::UnitX()) * Eigen::AngleAxisd(0.5, Vector3d::UnitZ()))
          .toRotationMatrix();
  const Vector3d translation(0.3, -0.2, 2.5);
  TagCorners corners;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2d q = 0.16 * unit_corner(i);
    const Vector3d p = rotation * Vector3d(q.x(), q.y(), 0) + translation;
    corners[i] = p.head<2>() / p.z();
  }
  const auto poses = planar_poses(corners, 0.16);
  ASSERT_TRUE(poses);
  EXPECT_NEAR(((*poses)[0].rotation - rotation).norm(), 0, 1e-6);
  EXPECT_NEAR(((*poses)[0].translation_m - translation).norm(), 0, 1e-6);
  EXPECT_GT(((*poses)[1].rotation - rotation).norm(), 0.1) << "the other leans the other way";
}

TEST(FloorStart, StandsNearTheTruthWhicheverWayTheTagsLean) {
  for (const Scene& truth : {support::phone_scene(), support::ceiling_scene()}) {
    std::vector<SeenFloorTag> tags;
    for (std::size_t i = 0; i < truth.tags.size(); ++i)
      tags.push_back({truth.tags[i].id, floor_corners(truth, i)});
    const auto start = floor_start(tags, truth.width_px, truth.height_px, 0.16);
    ASSERT_TRUE(start);
    // Without lens, blur or the right focal length; the estimator converges from much further away.
    for (std::size_t i = 0; i < tags.size(); ++i)
      EXPECT_NEAR(std::hypot(start->tags[i].pose.x_m - truth.tags[i].pose.x_m,
                             start->tags[i].pose.y_m - truth.tags[i].pose.y_m),
                  0, 0.35);
    EXPECT_GT(start->camera.position_m.z(), 1);
  }
}

}  // namespace
}  // namespace astro::film
