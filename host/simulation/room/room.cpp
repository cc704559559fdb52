#include "host/simulation/room/room.hpp"

#include <cmath>

namespace astro::simulation {
namespace {

double length_m(const Point2& from, const Point2& to) {
  return std::hypot(to.x_m - from.x_m, to.y_m - from.y_m);
}

}  // namespace

Point2 Walker::at(double time_s) const {
  double whole_m = 0;
  for (std::size_t i = 1; i < path.size(); ++i) whole_m += length_m(path[i - 1], path[i]);
  if (whole_m == 0) return path.front();
  double walked_m = std::fmod(speed_mps * time_s, 2 * whole_m);
  if (walked_m > whole_m) walked_m = 2 * whole_m - walked_m;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Point2 &from = path[i - 1], &to = path[i];
    const double piece_m = length_m(from, to);
    if (walked_m <= piece_m && piece_m > 0) {
      const double share = walked_m / piece_m;
      return {from.x_m + share * (to.x_m - from.x_m), from.y_m + share * (to.y_m - from.y_m)};
    }
    walked_m -= piece_m;
  }
  return path.back();
}

Room rectangular_room(const Point2& corner, const Point2& opposite) {
  const Point2 right{opposite.x_m, corner.y_m}, left{corner.x_m, opposite.y_m};
  return {{{corner, right}, {right, opposite}, {opposite, left}, {left, corner}}};
}

}  // namespace astro::simulation
