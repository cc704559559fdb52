#include <array>

#include "tests/target/replay/trace.hpp"

/// Runs the scripts and leaves the sums where the emulator reads them.
extern "C" {
[[gnu::used]] volatile std::uint32_t
    replay_sums[astro::target::Trace::kScripts * astro::target::Trace::kSums];
[[gnu::used]] volatile std::uint32_t replay_done;
}

int main() {
  using astro::target::Trace;
  static std::array<Trace, Trace::kScripts> traces{Trace(0), Trace(1)};  // too large for the stack
  for (int script = 0; script < Trace::kScripts; ++script) {
    Trace& trace = traces[static_cast<std::size_t>(script)];
    for (int tick = 0; tick < Trace::kTicks; ++tick) {
      trace.advance(tick);
      if (tick % Trace::kTicksPerSum == Trace::kTicksPerSum - 1)
        replay_sums[script * Trace::kSums + tick / Trace::kTicksPerSum] = trace.sum();
    }
  }
  replay_done = 1;
  while (true) asm volatile("wfi" ::: "memory");
}
