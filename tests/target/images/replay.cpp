#include "tests/target/replay/trace.hpp"

/// Runs a minute of the script and leaves the sums where the emulator reads them.
extern "C" {
[[gnu::used]] volatile std::uint32_t replay_sums[astro::target::Trace::kSums];
[[gnu::used]] volatile std::uint32_t replay_done;
}

int main() {
  static astro::target::Trace trace;
  for (int tick = 0; tick < astro::target::Trace::kTicks; ++tick) {
    trace.advance(tick);
    if (tick % astro::target::Trace::kTicksPerSum == astro::target::Trace::kTicksPerSum - 1)
      replay_sums[tick / astro::target::Trace::kTicksPerSum] = trace.sum();
  }
  replay_done = 1;
  while (true) asm volatile("wfi" ::: "memory");
}
