// Trajectories of TUM and EuRoC.
#include "host/truth/files/tum.hpp"

#include "tests/fuzz/target.hpp"
#include "tests/fuzz/track_laws.hpp"
#include "tests/host/truth/files/own_recordings.hpp"

namespace astro::fuzz {

void take(ByteView input) {
  reading_track([&] { return truth::read_tum(text_of(input), "x"); });
}

std::vector<Bytes> seeds() { return {bytes_of(test::kTum), bytes_of(test::kEuroc)}; }

}  // namespace astro::fuzz
