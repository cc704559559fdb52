#include "host/simulation/room/ray_caster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace astro::simulation {
namespace {
constexpr double kNothing_m = std::numeric_limits<double>::infinity();
}

RayCaster::RayCaster(const Room& room) : people_(room.people) {
  for (const RoomWall& wall : room.walls) {
    x_m_.push_back(wall.from.x_m);
    y_m_.push_back(wall.from.y_m);
    dx_m_.push_back(wall.to.x_m - wall.from.x_m);
    dy_m_.push_back(wall.to.y_m - wall.from.y_m);
  }
  for (const Walker& person : people_) circles_.push_back({person.at(0), person.radius_m * person.radius_m});
}

void RayCaster::move_people(double time_s) {
  for (std::size_t i = 0; i < people_.size(); ++i) circles_[i].centre = people_[i].at(time_s);
}

double RayCaster::distance_m(const Point2& from, double cosine, double sine) const {
  return std::min(wall_m(from, cosine, sine), person_m(from, cosine, sine));
}

double RayCaster::wall_m(const Point2& from, double cosine, double sine) const {
  double nearest_m = kNothing_m;
  for (std::size_t i = 0; i < x_m_.size(); ++i) {
    const double x = x_m_[i] - from.x_m, y = y_m_[i] - from.y_m;
    // A ray along the wall divides by zero; then `along` is infinite or a NaN, and no comparison with it holds.
    const double across = 1 / (cosine * dy_m_[i] - sine * dx_m_[i]);
    const double distance_m = (x * dy_m_[i] - y * dx_m_[i]) * across;
    const double along = (x * sine - y * cosine) * across;
    const bool met = (along >= 0) & (along <= 1) & (distance_m >= 0) & (distance_m < nearest_m);
    nearest_m = met ? distance_m : nearest_m;
  }
  return nearest_m;
}

double RayCaster::person_m(const Point2& from, double cosine, double sine) const {
  double nearest_m = kNothing_m;
  for (const Circle& person : circles_) {
    const double x = person.centre.x_m - from.x_m, y = person.centre.y_m - from.y_m;
    const double ahead_m = x * cosine + y * sine, aside_m = x * sine - y * cosine;
    const double half_square = person.square_m2 - aside_m * aside_m;
    if (x * x + y * y <= person.square_m2) return 0;
    if (ahead_m > 0 && half_square >= 0) nearest_m = std::min(nearest_m, ahead_m - std::sqrt(half_square));
  }
  return nearest_m;
}

}  // namespace astro::simulation
