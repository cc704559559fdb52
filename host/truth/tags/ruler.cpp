#include "host/truth/tags/ruler.hpp"

#include <string>

namespace astro::truth::tags {

void draw_ruler(Canvas& canvas, Place zero) {
  constexpr double kMark_mm = 0.15;
  // The line ends where the outer marks do.
  canvas.line({zero.x_mm - kMark_mm / 2, zero.y_mm}, {zero.x_mm + kRuler_mm + kMark_mm / 2, zero.y_mm}, 0.2);
  for (int mm = 0; mm <= static_cast<int>(kRuler_mm); ++mm) {
    const double height_mm = mm % 10 == 0 ? 5 : mm % 5 == 0 ? 3.5 : 2;
    const double x_mm = zero.x_mm + mm;
    canvas.line({x_mm, zero.y_mm - height_mm}, {x_mm, zero.y_mm}, kMark_mm);
    if (mm % 10 == 0) canvas.text({x_mm, zero.y_mm + 3.6}, std::to_string(mm), 2.8, Align::centre);
  }
  canvas.text({zero.x_mm + kRuler_mm + 3.5, zero.y_mm + 3.6}, "mm", 2.8);
}

}  // namespace astro::truth::tags
