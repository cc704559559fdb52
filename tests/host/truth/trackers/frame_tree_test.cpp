#include "host/truth/trackers/frame_tree.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/support/base/remarks.hpp"

namespace astro::truth {
namespace {

using testing::ElementsAre;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

ros2::StampedPose edge(const std::string& parent, const std::string& child, double x_m = 1,
                       double theta_rad = 0) {
  return {0, parent, child, x_m, 0, 0, 0, 0, std::sin(theta_rad / 2), std::cos(theta_rad / 2)};
}

Pose3 any_pose(std::mt19937& random) {
  std::normal_distribution<double> normal;
  Pose3 pose{normal(random), normal(random), normal(random), normal(random),
             normal(random), normal(random), normal(random)};
  const double length = std::hypot(std::hypot(pose.qx, pose.qy), std::hypot(pose.qz, pose.qw));
  for (double* q : {&pose.qx, &pose.qy, &pose.qz, &pose.qw}) *q /= length;
  return pose;
}

void expect_same(const Pose3& a, const Pose3& b) {
  constexpr double kRounding = 1e-14;  // some tens of operations on numbers about 1
  EXPECT_NEAR(a.x_m, b.x_m, kRounding);
  EXPECT_NEAR(a.y_m, b.y_m, kRounding);
  EXPECT_NEAR(a.z_m, b.z_m, kRounding);
  EXPECT_NEAR(a.qx, b.qx, kRounding);
  EXPECT_NEAR(a.qy, b.qy, kRounding);
  EXPECT_NEAR(a.qz, b.qz, kRounding);
  EXPECT_NEAR(a.qw, b.qw, kRounding);
}

TEST(Composed, AQuarterTurnAboutEachAxisTurnsWhatIsInside) {
  const double h = std::sqrt(0.5);
  const Pose3 inner{1, 2, 3, 0, 0, 0, 1};
  expect_same(composed({10, 20, 30, h, 0, 0, h}, inner), {11, 17, 32, h, 0, 0, h});
  expect_same(composed({10, 20, 30, 0, h, 0, h}, inner), {13, 22, 29, 0, h, 0, h});
  expect_same(composed({10, 20, 30, 0, 0, h, h}, inner), {8, 21, 33, 0, 0, h, h});
}

TEST(Composed, IsAssociativeAndKnowsTheIdentity) {
  constexpr unsigned kSeed = 7;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937 random(kSeed);
  for (int i = 0; i < 100; ++i) {
    const Pose3 a = any_pose(random), b = any_pose(random), c = any_pose(random);
    expect_same(composed(composed(a, b), c), composed(a, composed(b, c)));
    expect_same(composed(a, Pose3{}), a);
    expect_same(composed(Pose3{}, a), a);
  }
}

TEST(Composed, TheLengthOfARotationMakesNoDifferenceAndNoRotationMakesNoPose) {
  expect_same(composed({0, 0, 0, 0, 0, 1.1, 1.1}, {1, 0, 0, 0, 0, 0, 1}),
              composed({0, 0, 0, 0, 0, std::sqrt(0.5), std::sqrt(0.5)}, {1, 0, 0, 0, 0, 0, 1}));
  EXPECT_FALSE(is_possible(composed({0, 0, 0, 0, 0, 0, 0}, {1, 0, 0, 0, 0, 0, 1}))) << "a body that is lost";
  EXPECT_FALSE(is_possible(composed({1, 2, 3, kNaN, 0, 0, 1}, {1, 0, 0, 0, 0, 0, 1})));
}

TEST(FrameTree, AChainGoesFromTheChildUpToTheParent) {
  FrameTree tree;
  tree.put(edge("world", "markers"), false);
  tree.put(edge("markers", "base_link"), true);
  tree.put(edge("base_link", "wheel"), true);
  EXPECT_THAT(tree.chain("base_link", "world"), ElementsAre("base_link", "markers", "world"));
  EXPECT_THAT(tree.chain("base_link", ""), ElementsAre("base_link", "markers"));
  EXPECT_THAT(tree.chain("base_link", "wheel"), ElementsAre("base_link", "markers", "world"))
      << "as far as known";
  EXPECT_THAT(tree.chain("other", "world"), ElementsAre("other"));
}

TEST(FrameTree, APoseIsComposedOfAllTransformsBetween) {
  FrameTree tree;
  tree.put(edge("world", "markers", 2, M_PI / 2), false);
  tree.put(edge("markers", "base_link", -0.5), true);
  const Pose3 pose = tree.pose(tree.chain("base_link", "world"));
  const Pose2 floor = on_floor(pose, UpAxis::z);
  EXPECT_NEAR(floor.x_m, 2, 1e-15);
  EXPECT_NEAR(floor.y_m, -0.5, 1e-15);
  EXPECT_NEAR(floor.theta_rad, M_PI / 2, 1e-15);
}

TEST(FrameTree, NewPosesComeFromTheTransformThatMoves) {
  FrameTree tree;
  tree.put(edge("room", "world"), false);
  tree.put(edge("world", "markers"), false);
  tree.put(edge("markers", "base_link"), true);
  const auto chain = tree.chain("base_link", "room");
  EXPECT_EQ(tree.moving(chain), "world") << "the topmost, as long as none has moved";
  tree.put(edge("world", "markers", 1.001), false);
  EXPECT_EQ(tree.moving(chain), "markers");
  tree.put(edge("room", "world"), false);
  EXPECT_EQ(tree.moving(chain), "markers") << "the other one is said again, but has not moved";
}

TEST(FrameTree, WhereAllTransformsAreFixedNothingMoves) {
  FrameTree tree;
  tree.put(edge("world", "base_link"), true);
  tree.put(edge("world", "base_link", 2), true);
  EXPECT_EQ(tree.moving(tree.chain("base_link", "world")), std::nullopt);
}

TEST(FrameTree, TwoThatMoveAreNoMeasurement) {
  FrameTree tree;
  for (const double x_m : {1.0, 2.0}) {
    tree.put(edge("map", "drift", x_m), false);
    tree.put(edge("drift", "base_link", x_m), false);
  }
  EXPECT_THAT([&] { tree.moving(tree.chain("base_link", "map")); },
              support::ThrowsTelling(FrameProblem::two_move, "map", "base_link", "base_link", "drift"));
}

TEST(FrameTree, ACircleAndAnyNumberOfFramesComeToAnEnd) {
  FrameTree tree;
  tree.put(edge("a", "b"), false);
  tree.put(edge("b", "a"), false);
  tree.put(edge("c", "c"), false);
  EXPECT_LE(tree.chain("a", "world").size(), 64U);
  EXPECT_LE(tree.chain("c", "world").size(), 64U);
  tree.moving(tree.chain("a", "world"));
  for (int i = 0; i < 10'000; ++i) tree.put(edge("world", "f" + std::to_string(i)), false);
  EXPECT_EQ(tree.chain("f9999", "world").size(), 1U) << "beyond some thousand they are left out";
  EXPECT_EQ(tree.chain("f99", "world").size(), 2U);
}

TEST(FrameTree, ALeadingSlashIsNoPartOfAName) {
  FrameTree tree;
  tree.put(edge("/world", "/robot"), false);
  EXPECT_THAT(tree.chain("robot", "world"), ElementsAre("robot", "world"));
  EXPECT_EQ(plain_frame("/a/b"), "a/b");
  EXPECT_EQ(plain_frame(""), "");
}

}  // namespace
}  // namespace astro::truth
