#pragma once

#include <vector>

#include "host/simulation/room/room.hpp"

namespace astro::simulation {

/// Finds what a ray meets first. A ray o + t d meets a wall p + u e where
///
///   t = (p - o) x e / d x e,   u = (p - o) x d / d x e,   t >= 0, 0 <= u <= 1
///
/// Cost  a ray looks at every wall, with one division each. A grid over the room would serve rooms of many hundreds of walls.
class RayCaster {
 public:
  explicit RayCaster(const Room& room);

  /// Moves the people to where they are at this time, which must be called before the first ray.
  void move_people(double time_s);

  /// The distance from `from` to the first wall or person in the direction (cosine, sine); infinite if there is none. From inside
  /// a person's circle that person is at distance 0.
  double distance_m(const Point2& from, double cosine, double sine) const;

 private:
  double wall_m(const Point2& from, double cosine, double sine) const;
  double person_m(const Point2& from, double cosine, double sine) const;

  struct Circle {
    Point2 centre;
    double square_m2;  // of its radius
  };

  std::vector<double> x_m_, y_m_, dx_m_, dy_m_;  // of the walls: one end, and from there to the other
  std::vector<Walker> people_;
  std::vector<Circle> circles_;
};

}  // namespace astro::simulation
