// Tables of a tracked body with named columns.
#include "host/truth/files/plain_csv.hpp"

#include "tests/fuzz/target.hpp"
#include "tests/fuzz/track_laws.hpp"
#include "tests/host/truth/files/own_recordings.hpp"

namespace astro::fuzz {

void take(ByteView input) {
  reading_track([&] { return truth::read_plain({text_of(input), "x"}); });
}

std::vector<Bytes> seeds() {
  return {bytes_of(test::kPlain), bytes_of("__time;/a/position/x;/a/position/y;/a/yaw (deg)\n1,5;2;3,25;4\n"),
          bytes_of("stamp.sec,stamp.nanosec,tag_id,posX,posY,yaw\n1,2,5,1,2,90\n1,3,6,1,3,90\n"),
          bytes_of("time\tx\ty\troll\tpitch\tyaw\n23:59:59.9\t1\t2\t0\t0\t1\n00:00:00.1\t1\t2\t0\t0\t1\n")};
}

}  // namespace astro::fuzz
