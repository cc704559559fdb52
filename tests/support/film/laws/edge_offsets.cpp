#include "tests/support/film/laws/edge_offsets.hpp"

#include <cmath>

namespace astro::support::film {

double GreyPicture::at(double u, double v) const {
  const int left = static_cast<int>(std::floor(u)), top = static_cast<int>(std::floor(v));
  const auto pixel = [&](int column, int row) {
    return static_cast<double>(grey.at(static_cast<std::size_t>(row * width_px + column)));
  };
  const double du = u - left, dv = v - top;
  return std::lerp(std::lerp(pixel(left, top), pixel(left + 1, top), du),
                   std::lerp(pixel(left, top + 1), pixel(left + 1, top + 1), du), dv);
}

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

}  // namespace astro::support::film
