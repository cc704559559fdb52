#pragma once

namespace astro::target {

/// What users flash.
inline constexpr const char* kImage = ASTRO_IMAGE_DIR "/astrolabe-teensy40.hex";

}  // namespace astro::target
