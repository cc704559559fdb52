#pragma once

#include <vector>

#include "host/base/pose2.hpp"

/// What stands and walks around a simulated robot, as a plane at the height of its laser scanner.
///
/// Frame  of the simulated world: the robot starts at (0, 0) and looks along x.
/// Units  metres, metres per second, seconds
namespace astro::simulation {

/// A straight wall between two points, visible from both sides.
struct RoomWall {
  Point2 from, to;
};

/// A person: a circle that walks along a path and back again, for ever. One point: somebody who stands there.
struct Walker {
  std::vector<Point2> path;
  double speed_mps = 0.8;
  double radius_m = 0.2;

  /// Where the person is, `time_s` after leaving the first point. Precondition: a path of at least one point.
  Point2 at(double time_s) const;
};

struct Room {
  std::vector<RoomWall> walls;
  std::vector<Walker> people = {};
};

/// Four walls around the rectangle between two opposite corners.
Room rectangular_room(const Point2& corner, const Point2& opposite);

}  // namespace astro::simulation
