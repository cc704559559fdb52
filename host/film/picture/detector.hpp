#pragma once

#include <memory>
#include <vector>

#include "host/film/picture/gray_frame.hpp"
#include "host/film/picture/tag_corners.hpp"

namespace astro::film {

struct DetectedTag {
  int id = 0;
  int wrong_bits = 0;  // that were corrected
  TagCorners corners;  // to about half a pixel
};

/// Part of a picture: from (left, top), within it.
struct Window {
  int left = 0, top = 0, width = 0, height = 0;
};

inline Window whole_of(const GrayFrame& frame) { return {0, 0, frame.width, frame.height}; }

/// What is wrong with a picture. Values: its width and height.
enum class DetectorProblem { picture_too_large };

/// Finds tags of the family tag36h11 with libapriltag.
///
/// Cost     1080p, one core: 170 ms with decimate 1, 43 ms with 2; of a window in proportion. With decimate 2 tags whose short
///          side is below about 25 px are missed.
/// Threads  one.
class TagDetector {
 public:
  TagDetector();
  ~TagDetector();
  TagDetector(const TagDetector&) = delete;
  TagDetector& operator=(const TagDetector&) = delete;

  /// Finds tags with at most one wrong bit; hardly anything else looks like that. Corners are in pixels of
  /// the whole picture. Finds none in a window that has fewer pixels on a side than a tag has cells. Throws
  /// astro::Error if a side of the window has more than 32767 pixels.
  std::vector<DetectedTag> detect(const GrayFrame& frame, const Window& window, double decimate);

 private:
  struct Library;
  std::unique_ptr<Library> library_;
};

}  // namespace astro::film
