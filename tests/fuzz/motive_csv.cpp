// What OptiTrack Motive exports.
#include "host/truth/files/motive_csv.hpp"

#include "tests/fuzz/target.hpp"
#include "tests/fuzz/track_laws.hpp"
#include "tests/host/truth/files/own_recordings.hpp"

namespace astro::fuzz {

void take(ByteView input) {
  const std::string_view text = text_of(input);
  reading_track([&] {
    for (const truth::BodyName& body : truth::bodies_in_motive(text, "x"))
      reading_track([&] { return truth::read_motive(text, "x", body.name); });
    return truth::read_motive(text, "x");
  });
}

std::vector<Bytes> seeds() { return {bytes_of(test::kMotive)}; }

}  // namespace astro::fuzz
