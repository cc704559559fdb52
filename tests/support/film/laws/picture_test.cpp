#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <set>
#include <vector>

#include "tests/support/film/film_stage.hpp"
#include "tests/support/film/picture/renderer.hpp"
#include "tests/support/tags/read_tags.hpp"

// One picture, against formulas that are written here once more.

namespace astro::support::film {

namespace {

struct GreyPicture {
  int width_px, height_px;
  std::vector<std::uint8_t> grey;

  /// Between pixels: bilinear.
  double at(double u, double v) const {
    const int left = static_cast<int>(std::floor(u)), top = static_cast<int>(std::floor(v));
    const auto pixel = [&](int column, int row) {
      return static_cast<double>(grey.at(static_cast<std::size_t>(row * width_px + column)));
    };
    const double du = u - left, dv = v - top;
    return std::lerp(std::lerp(pixel(left, top), pixel(left + 1, top), du),
                     std::lerp(pixel(left, top + 1), pixel(left + 1, top + 1), du), dv);
  }
};

struct PicturePlace {
  double u, v;
};

/// Where a black square's edges are, against where they should be: the mean distance of the four edges of a square in pixels,
/// positive if the black is larger. `expected(edge, part)` is the place of an edge's point, part from 0 to 1; edges go round
/// clockwise in the picture. An edge's place is the centroid of the brightness's slope across it, which is without bias for a
/// symmetric blur in linear light.
std::array<double, 4> edge_offsets_px(const GreyPicture& picture,
                                      const std::function<PicturePlace(int, double)>& expected,
                                      double reach_px) {
  std::array<double, 4> offsets{};
  for (int edge = 0; edge < 4; ++edge) {
    double sum = 0;
    int profiles = 0;
    for (double part = 0.12; part <= 0.88; part += 0.01, ++profiles) {
      const PicturePlace at = expected(edge, part), before = expected(edge, part - 0.01),
                         after = expected(edge, part + 0.01);
      const double du = after.u - before.u, dv = after.v - before.v, length = std::hypot(du, dv);
      const double out_u = dv / length, out_v = -du / length;  // clockwise on the screen: outside is left
      constexpr double kStep_px = 0.25;
      double slopes = 0, moments = 0;
      for (double away = -reach_px; away < reach_px; away += kStep_px) {
        const double slope = picture.at(at.u + (away + kStep_px) * out_u, at.v + (away + kStep_px) * out_v) -
                             picture.at(at.u + away * out_u, at.v + away * out_v);
        slopes += slope;
        moments += slope * (away + kStep_px / 2);
      }
      sum += moments / slopes;
    }
    offsets[static_cast<std::size_t>(edge)] = sum / profiles;
  }
  return offsets;
}

constexpr double kReach_px = 4;  // less than a cell of the tags below

// Linear light without noise, so that the centre of an edge is where the edge is.
SensorModel plain_sensor() {
  SensorModel sensor;
  sensor.tone = Tone::power;
  sensor.gamma = 1;
  sensor.vignetting = sensor.read_noise = sensor.shot_noise = 0;
  return sensor;
}

/// A lens with all its terms, in a camera that is near enough for large cells.
Lens strange_lens() { return {1920, 1080, 1700, 971.5, 531.5, 0.08, -0.15, 4e-4, -3e-4, 0.03}; }
Camera near_camera() { return looking_at({0.15, -1.05, 1.35}, {0.05, 0.05, 0}, 3 * kDegree); }

PoseTrack driving() {
  // 0.4 m/s along +x and 1.5 rad/s: as fast as the programme's squares.
  std::vector<FloorPose> poses;
  for (int i = 0; i <= 200; ++i) poses.push_back({-0.04 + 0.0004 * i, 0.05, 0.3 + 0.0015 * i});
  return {0, 1e-3, poses};
}

Scene scene_with(const PoseTrack& track) {
  Scene scene;
  scene.robots.push_back(filmed(track));
  scene.floor.push_back({TagPaper(1, 0.16), {-0.38, 0.1, 0.35}, 0.004});
  scene.floor.push_back({TagPaper(2, 0.16), {0.42, 0.15, -1.2}});
  return scene;
}

GreyPicture picture_of(const Scene& scene, const Shutter& shutter, double first_row_s,
                       const SensorModel& sensor = plain_sensor(), double blur_px = 0.65) {
  const Lens lens = strange_lens();
  Renderer renderer(scene, lens, blur_px, sensor, 5);
  GreyPicture picture{lens.width_px, lens.height_px, {}};
  picture.grey.resize(static_cast<std::size_t>(lens.width_px) * static_cast<std::size_t>(lens.height_px));
  renderer.render(near_camera(), shutter, first_row_s, picture.grey.data());
  return picture;
}

struct Spot {
  double x, y, z;
};

/// World to pixel, written from the camera's rows and Brown's formula term by term.
PicturePlace projected(const Spot& spot) {
  const Lens lens = strange_lens();
  const Camera camera = near_camera();
  double seen[3] = {0, 0, 0};
  const double away[3] = {spot.x - camera.position_m[0], spot.y - camera.position_m[1],
                          spot.z - camera.position_m[2]};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      seen[row] += camera.world_to_camera(row, column) * away[column];
  const double x = seen[0] / seen[2], y = seen[1] / seen[2];
  const double radius = std::sqrt(x * x + y * y);
  const double radial =
      lens.k1 * std::pow(radius, 2) + lens.k2 * std::pow(radius, 4) + lens.k3 * std::pow(radius, 6);
  const double u = x + x * radial + 2 * lens.p1 * x * y + lens.p2 * (3 * x * x + y * y);
  const double v = y + y * radial + lens.p1 * (x * x + 3 * y * y) + 2 * lens.p2 * x * y;
  return {lens.cx_px + lens.f_px * u, lens.cy_px + lens.f_px * v};
}

/// A point of a tag's edge; edges run from the upper left corner clockwise as the upright tag is seen.
Spot on_edge(int edge, double part, double side_m) {
  const double along = (part - 0.5) * side_m, half = side_m / 2;
  const Spot spots[4] = {{along, half, 0}, {half, -along, 0}, {-along, -half, 0}, {-half, along, 0}};
  return spots[edge];
}

/// In the frame of the floor. A tilt turns about the tag's x axis first, then about its y axis.
Spot placed(const Spot& on_tag, const FloorPose& pose, double z_m, double tilt_x = 0, double tilt_y = 0) {
  const double y = on_tag.y * std::cos(tilt_x), up = on_tag.y * std::sin(tilt_x);
  const double x = on_tag.x * std::cos(tilt_y) + up * std::sin(tilt_y);
  const double z = up * std::cos(tilt_y) - on_tag.x * std::sin(tilt_y);
  const double c = std::cos(pose.theta_rad), s = std::sin(pose.theta_rad);
  return {pose.x_m + c * x - s * y, pose.y_m + s * x + c * y, z_m + z};
}

FloorPose robots_tag(const FilmedRobot& robot, const FloorPose& body) {
  const double c = std::cos(body.theta_rad), s = std::sin(body.theta_rad);
  return {body.x_m + c * robot.lever.x_m - s * robot.lever.y_m,
          body.y_m + s * robot.lever.x_m + c * robot.lever.y_m, body.theta_rad + robot.lever.theta_rad};
}

/// `pose_at(row)`: of the tag when this row was exposed.
template <class PoseAt>
std::array<double, 4> robot_offsets(const GreyPicture& picture, const FilmedRobot& robot, PoseAt pose_at) {
  return edge_offsets_px(
      picture,
      [&](int edge, double part) {
        PicturePlace at{0, 0};
        for (int round = 0; round < 4; ++round)  // the row decides the pose, and the pose the row
          at = projected(placed(on_edge(edge, part, robot.paper.side_m()), pose_at(at.v), robot.height_m,
                                robot.tilt_x_rad, robot.tilt_y_rad));
        return at;
      },
      kReach_px);
}

double largest(const std::array<double, 4>& offsets) {
  double most = 0;
  for (const double offset : offsets) most = std::max(most, std::abs(offset));
  return most;
}

constexpr double kEdge_px = 0.02;  // up to 0.013 is what 8 bits and the samples of a pixel leave

TEST(Picture, HasTheEdgesOfFloorTagsWhereAnIndependentFormulaPutsThem) {
  const Scene scene = scene_with(PoseTrack::standing({0, 0.05, 0.3}));
  const GreyPicture picture = picture_of(scene, {}, 0);
  for (const FloorTag& tag : scene.floor) {
    const auto offsets = edge_offsets_px(
        picture,
        [&](int edge, double part) {
          return projected(placed(on_edge(edge, part, tag.paper.side_m()), tag.pose, tag.z_m));
        },
        kReach_px);
    EXPECT_LT(largest(offsets), kEdge_px) << "tag " << tag.paper.id();
  }
}

TEST(Picture, HasTheEdgesOfTheRobotsTagWhereAnIndependentFormulaPutsThem) {
  const FloorPose body{0, 0.05, 0.3};
  const Scene scene = scene_with(PoseTrack::standing(body));
  const FilmedRobot& robot = scene.robots[0];
  const auto offsets =
      robot_offsets(picture_of(scene, {}, 0), robot, [&](double) { return robots_tag(robot, body); });
  EXPECT_LT(largest(offsets), kEdge_px);
}

TEST(Picture, OfAShutterThatReadsAllRowsAtOnceHasNoSkew) {
  const Scene scene = scene_with(driving());
  const FilmedRobot& robot = scene.robots[0];
  const FloorPose tag = robots_tag(robot, robot.track.at(0.1));
  for (const double exposure_s : {0.0, 0.004}) {
    const GreyPicture picture = picture_of(scene, {0, exposure_s}, 0.1);
    EXPECT_LT(largest(robot_offsets(picture, robot, [&](double) { return tag; })), kEdge_px) << exposure_s;
  }
}

class RollingShutter : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(BothWays, RollingShutter, testing::Values(0.02, -0.02),
                         [](const auto& readout) { return readout.param > 0 ? "Downwards" : "Upwards"; });

TEST_P(RollingShutter, ShowsEachRowAtItsOwnTime) {
  const Scene scene = scene_with(driving());
  const FilmedRobot& robot = scene.robots[0];
  const GreyPicture picture = picture_of(scene, {GetParam(), 0.004}, 0.1);
  const auto at_row = [&](double row) {
    return robots_tag(robot, robot.track.at(0.1 + row / strange_lens().height_px * GetParam()));
  };
  EXPECT_LT(largest(robot_offsets(picture, robot, at_row)), kEdge_px);
  // And it does matter: 0.4 m/s for 10 ms are 4 mm, which are some 4 pixels here; with one pose for all rows the edges are
  // far off even if the pose is that of the tag's middle.
  const double middle = projected(placed({0, 0, 0}, at_row(540), robot.height_m)).v;
  const auto at_middle = [&](double) { return at_row(middle); };
  EXPECT_GT(largest(robot_offsets(picture, robot, at_middle)), 3 * kEdge_px);
}

TEST(Picture, IsReadByLibapriltag) {
  const Scene scene = scene_with(driving());
  SensorModel sensor;
  sensor.read_noise = 0.006;
  sensor.shot_noise = 6e-4;
  const GreyPicture picture = picture_of(scene, {}, 0.1, sensor);
  std::multiset<int> ids;
  for (const ReadTag& tag : read_tags(picture.grey, picture.width_px, picture.height_px)) {
    EXPECT_EQ(tag.wrong_bits, 0);
    ids.insert(tag.id);
  }
  EXPECT_THAT(ids, testing::ElementsAre(0, 1, 2));
}

TEST(Picture, OfMirroredTagsIsNotRead) {
  Scene scene = scene_with(driving());
  for (FloorTag& tag : scene.floor) tag.paper = TagPaper(tag.paper.id(), tag.paper.side_m(), 1, true);
  const GreyPicture picture = picture_of(scene, {}, 0.1);
  const auto tags = read_tags(picture.grey, picture.width_px, picture.height_px);
  ASSERT_EQ(tags.size(), 1U);
  EXPECT_EQ(tags[0].id, 0);
}

TEST(Picture, HidesWhatALegCovers) {
  Scene scene = scene_with(driving());
  scene.legs.push_back({0, 1, {-0.38, 0.08, 0}, {-0.38, 0.08, 0}});
  const GreyPicture picture = picture_of(scene, {}, 0.1);
  std::multiset<int> ids;
  for (const ReadTag& tag : read_tags(picture.grey, picture.width_px, picture.height_px)) ids.insert(tag.id);
  EXPECT_THAT(ids, testing::ElementsAre(0, 2));
}

}  // namespace

}  // namespace astro::support::film
