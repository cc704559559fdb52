#include "tests/support/tags/read_tags.hpp"

#include <apriltag/apriltag.h>
#include <apriltag/common/zarray.h>
#include <apriltag/tag36h11.h>

#include <memory>

namespace astro::support {
namespace {

/// libapriltag's order begins at the lower left corner and goes round counter-clockwise; its pixel centres are at .5.
ReadTag tag_of(const apriltag_detection_t& found) {
  ReadTag tag{found.id, found.hamming, {}};
  constexpr std::array<std::size_t, 4> kOrder{3, 2, 1, 0};
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const auto& point = found.p[kOrder[corner]];
    tag.corners[corner] = {point[0] - 0.5, point[1] - 0.5};
  }
  return tag;
}

}  // namespace

std::vector<ReadTag> read_tags(std::span<const std::uint8_t> grey, int width_px, int height_px,
                               float decimate) {
  // libapriltag takes a picture that it does not change, but not as const.
  image_u8_t picture{width_px, height_px, width_px, const_cast<std::uint8_t*>(grey.data())};
  const std::unique_ptr<apriltag_family_t, decltype(&tag36h11_destroy)> family(tag36h11_create(),
                                                                               &tag36h11_destroy);
  const std::unique_ptr<apriltag_detector_t, decltype(&apriltag_detector_destroy)> detector(
      apriltag_detector_create(), &apriltag_detector_destroy);
  apriltag_detector_add_family_bits(detector.get(), family.get(), 1);
  detector->quad_decimate = decimate;
  const std::unique_ptr<zarray_t, decltype(&apriltag_detections_destroy)> all(
      apriltag_detector_detect(detector.get(), &picture), &apriltag_detections_destroy);
  std::vector<ReadTag> tags;
  for (int index = 0; index < zarray_size(all.get()); ++index) {
    apriltag_detection_t* found = nullptr;
    zarray_get(all.get(), index, &found);
    tags.push_back(tag_of(*found));
  }
  return tags;
}

}  // namespace astro::support
