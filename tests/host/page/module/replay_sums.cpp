#include <cstdio>

#include "tests/target/replay/trace.hpp"

/// The check sums of two minutes of odometry and duty, one a line: the module's processor against this machine's, as
/// tests/target/replay holds this machine's against the robot's.
int main() {
  using astro::target::Trace;
  for (int script = 0; script < Trace::kScripts; ++script) {
    Trace trace(script);
    for (int tick = 0; tick < Trace::kTicks; ++tick) {
      trace.advance(tick);
      if (tick % Trace::kTicksPerSum == Trace::kTicksPerSum - 1)
        std::printf("%08x\n", static_cast<unsigned>(trace.sum()));
    }
  }
}
