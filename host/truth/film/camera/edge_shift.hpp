#pragma once

#include "host/truth/film/tags/tag_corners.hpp"

namespace astro::film {

/// The corners of a tag whose four edges are shifted by `shift_px` into the black. Blur, sharpening and a tone curve that is
/// not the assumed one shift all edges alike.
TagCorners with_edges_shifted(const TagCorners& corners, double shift_px);

}  // namespace astro::film
