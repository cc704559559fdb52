// Tables of a tracked body with named columns.
#include "host/truth/files/plain_csv.hpp"

#include "tests/fuzz/target.hpp"
#include "tests/fuzz/track_laws.hpp"
#include "tests/host/truth/files/own_recordings.hpp"

namespace astro::fuzz {

void take(ByteView input) {
  reading_track([&] { return truth::read_plain(text_of(input), "x"); });
}

std::vector<Bytes> seeds() {
  return {bytes_of(test::kPlain),
          bytes_of("__time;/a/position/x;/a/position/y;/a/yaw (deg)\n1,5;2;3,25;4\n")};
}

}  // namespace astro::fuzz
