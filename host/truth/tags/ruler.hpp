#pragma once

#include "host/truth/tags/canvas.hpp"

namespace astro::truth::tags {

inline constexpr double kRuler_mm = 100;

/// A ruler of kRuler_mm with a mark each millimetre and a number each ten, by which a person checks the printer's scale. The
/// marks stand on a line that begins at `zero`; numbers are below it.
void draw_ruler(Canvas& canvas, Place zero);

}  // namespace astro::truth::tags
