// A recording of any format, by its content, and what is in it.
#include "host/truth/files/tracker_file.hpp"

#include "host/truth/floor/inspection.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/fuzz/track_laws.hpp"
#include "tests/host/truth/files/own_recordings.hpp"

namespace astro::fuzz {

void take(ByteView input) {
  const std::string_view text = text_of(input);
  reading_track([&] { return truth::read_track(text, "x"); });
  try {
    for (const truth::BodyInspection& body : truth::inspect(text, "x").bodies) {
      require(body.lost.all() <= body.samples, "no more samples are lost than there are");
      require(body.longest_gap_s <= body.duration_s, "a gap lies within the recording");
    }
  } catch (const Error&) {
  }
}

std::vector<Bytes> seeds() {
  return {
      bytes_of(test::kMotive),
      bytes_of(test::kVicon),
      bytes_of(test::kTum),
      bytes_of(test::kEuroc),
      bytes_of(test::kPlain),
      bytes_of(
          "NO_OF_FRAMES\t2\nFREQUENCY\t100\nBODY_NAMES\trobot\nrobot X\tY\tZ\tRoll\tPitch\tYaw\tResidual\n"
          "1\t2\t3\t0\t0\t90\t0.5\n1\t2\t3\t0\t0\t91\t0.5\n"),
      bytes_of("NO_OF_FRAMES\t2\nNO_OF_MARKERS\t1\nFREQUENCY\t100\nDATA_INCLUDED\t3D\nMARKER_NAMES\tm1\n"
               "1\t2\t3\n1\t2\t4\n")};
}

}  // namespace astro::fuzz
