#include "host/film/picture/detector.hpp"

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>

#include <algorithm>
#include <string>

#include "host/base/error.hpp"

namespace astro::film {
namespace {

// libapriltag stores half pixels in 16 bits, and aborts the program if a picture is larger.
constexpr int kLongestSide_px = 32'767;

}  // namespace

struct TagDetector::Library {
  apriltag_family_t* family = tag36h11_create();
  apriltag_detector_t* detector = apriltag_detector_create();
  Library() { apriltag_detector_add_family_bits(detector, family, 1); }
  ~Library() {
    apriltag_detector_destroy(detector);
    tag36h11_destroy(family);
  }
};

TagDetector::TagDetector() : library_(std::make_unique<Library>()) {
  library_->detector->nthreads = 1;
  library_->detector->refine_edges = true;
}

TagDetector::~TagDetector() = default;

std::vector<DetectedTag> TagDetector::detect(const GrayFrame& frame, const Window& window, double decimate) {
  if (std::max(window.width, window.height) > kLongestSide_px)
    throw Error("tags cannot be looked for in a picture of " + std::to_string(window.width) + " x " +
                    std::to_string(window.height) + " pixels",
                DetectorProblem::picture_too_large,
                {std::to_string(window.width), std::to_string(window.height)});
  // The library reads out of bounds if a picture is smaller than one of its tiles.
  if (std::min(window.width, window.height) < kTagCells * decimate) return {};
  // The library only reads, although its type is not const. The rows need no copy, because the stride is that
  // of the whole picture.
  auto* pixels = const_cast<std::uint8_t*>(frame.row(window.top) + window.left);
  image_u8_t image{window.width, window.height, frame.width, pixels};
  library_->detector->quad_decimate = static_cast<float>(decimate);
  zarray_t* found = apriltag_detector_detect(library_->detector, &image);
  std::vector<DetectedTag> tags;
  for (int i = 0; i < zarray_size(found); ++i) {
    apriltag_detection_t* one = nullptr;
    zarray_get(found, i, static_cast<void*>(&one));
    DetectedTag tag{one->id, one->hamming, {}};
    // The library's pixel centres are at .5. Its corners go (-,+), (+,+), (+,-), (-,-) with y down the tag, which is our order.
    for (std::size_t corner = 0; corner < 4; ++corner)
      tag.corners[corner] = {one->p[corner][0] - 0.5 + window.left, one->p[corner][1] - 0.5 + window.top};
    tags.push_back(tag);
  }
  apriltag_detections_destroy(found);
  return tags;
}

}  // namespace astro::film
