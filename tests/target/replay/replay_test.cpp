#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>

#include "host/emulator/robot/teensy.hpp"
#include "tests/support/programs/elf_symbols.hpp"
#include "tests/target/replay/trace.hpp"

namespace astro::target {
namespace {

using namespace std::chrono_literals;

TEST(Replay, MinutesOfOdometryAndDutyHaveTheSameBitsOnTheHostAndOnTheProcessor) {
  emulator::Teensy teensy(ASTRO_IMAGE_DIR "/replay.hex");
  const auto symbols = support::elf_symbols(ASTRO_IMAGE_DIR "/replay.elf");
  ASSERT_TRUE(teensy.run_until([&] { return teensy.word_at(symbols.at("replay_done")) == 1; }, 20s, 10ms));
  std::array<std::uint32_t, Trace::kScripts> last{};
  for (int script = 0; script < Trace::kScripts; ++script) {
    Trace trace(script);
    for (int tick = 0; tick < Trace::kTicks; ++tick) {
      trace.advance(tick);
      if (tick % Trace::kTicksPerSum != Trace::kTicksPerSum - 1) continue;
      const int sum = script * Trace::kSums + tick / Trace::kTicksPerSum;
      ASSERT_EQ(teensy.word_at(symbols.at("replay_sums") + 4 * static_cast<std::uint32_t>(sum)), trace.sum())
          << "script " << script << ", apart within second " << tick / Trace::kTicksPerSum;
    }
    last[static_cast<std::size_t>(script)] = trace.sum();
    EXPECT_NE(trace.pose().x, 0);
    EXPECT_NE(trace.pose().theta.raw(), 0U) << "the script should turn";
  }
  EXPECT_NE(last[0], last[1]) << "the curvature effect should change something";
  fmt::print("{} ticks, {} instructions each on the processor; the last sums are {:08x} and {:08x}\n",
             Trace::kScripts * Trace::kTicks, teensy.instructions() / (Trace::kScripts * Trace::kTicks),
             last[0], last[1]);
}

}  // namespace
}  // namespace astro::target
