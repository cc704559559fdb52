#include "host/film/picture/tag_picture.hpp"

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
#include <fmt/format.h>

#include <memory>

#include "host/base/error.hpp"

namespace astro::film::paper {

TagPicture tag_picture(int id) {
  const std::unique_ptr<apriltag_family_t, decltype(&tag36h11_destroy)> family(tag36h11_create(),
                                                                               &tag36h11_destroy);
  if (id < 0 || static_cast<unsigned>(id) >= family->ncodes)
    throw Error(fmt::format("there is no tag36h11 number {}, only 0 to {}", id, family->ncodes - 1));
  TagPicture picture;
  for (unsigned bit = 0; bit < family->nbits; ++bit)
    if ((family->codes[id] >> (family->nbits - 1 - bit) & 1U) != 0)
      picture.set_white(static_cast<int>(family->bit_y[bit]), static_cast<int>(family->bit_x[bit]));
  return picture;
}

}  // namespace astro::film::paper
