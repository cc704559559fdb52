#pragma once

#include <cstdint>
#include <span>

#include "host/base/bytes.hpp"

/// Uncompressed video with a stamp for each picture, as a stream that other programs read from a pipe: just enough Matroska.
///
/// Source  RFC 9559 (Matroska), RFC 8794 (EBML)
namespace astro::support::film {

/// What comes first. Pictures are I420: brightness, then two planes of colour of half the width and height.
Bytes raw_video_header(int width_px, int height_px, double fps);

/// What comes before the bytes of a picture.
Bytes raw_video_frame_header(std::int64_t pts_us, std::size_t picture_bytes);

}  // namespace astro::support::film
