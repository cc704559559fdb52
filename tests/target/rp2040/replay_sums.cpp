#include <cstdio>

#include "tests/target/replay/trace.hpp"

/// Prints the sums that the replay image leaves in its memory, computed on this computer: one a line.
int main() {
  using astro::target::Trace;
  for (int script = 0; script < Trace::kScripts; ++script) {
    Trace trace(script);
    for (int tick = 0; tick < Trace::kTicks; ++tick) {
      trace.advance(tick);
      if (tick % Trace::kTicksPerSum == Trace::kTicksPerSum - 1) std::printf("%08x\n", trace.sum());
    }
  }
}
