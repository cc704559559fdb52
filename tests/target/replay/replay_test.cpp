#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/emulator/robot/teensy.hpp"
#include "tests/support/programs/elf_symbols.hpp"
#include "tests/target/replay/trace.hpp"

namespace astro::target {
namespace {

using namespace std::chrono_literals;

TEST(Replay, AMinuteOfOdometryAndDutyHasTheSameBitsOnTheHostAndOnTheProcessor) {
  emulator::Teensy teensy(ASTRO_IMAGE_DIR "/replay.hex");
  const auto symbols = support::elf_symbols(ASTRO_IMAGE_DIR "/replay.elf");
  ASSERT_TRUE(teensy.run_until([&] { return teensy.word_at(symbols.at("replay_done")) == 1; }, 10s, 10ms));
  Trace trace;
  for (int tick = 0; tick < Trace::kTicks; ++tick) {
    trace.advance(tick);
    if (tick % Trace::kTicksPerSum != Trace::kTicksPerSum - 1) continue;
    const int second = tick / Trace::kTicksPerSum;
    ASSERT_EQ(teensy.word_at(symbols.at("replay_sums") + 4 * static_cast<std::uint32_t>(second)), trace.sum())
        << "apart within second " << second;
  }
  fmt::print("{} ticks, {} instructions each on the processor; the last sum is {:08x}\n", Trace::kTicks,
             teensy.instructions() / Trace::kTicks, trace.sum());
  EXPECT_NE(trace.pose().x, 0);
  EXPECT_NE(trace.pose().theta.raw(), 0U) << "the script should turn";
}

}  // namespace
}  // namespace astro::target
