#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/safety/fault.hpp"
#include "tests/support/robots/random.hpp"
#include "tests/support/robots/robot_life.hpp"

// Random lives of random robots; `./dev fuzz` runs ten thousand. ASTROLABE_LIVES=COUNT and ASTROLABE_LIVES_SEED=FIRST choose
// others than the default.
namespace astro {
namespace {

TEST(Lives, AfterThreeSecondsOfSilenceTheBridgesAreOpenAndAStopHoldsWhateverTheRobotIs) {
  const std::uint64_t count = support::number_from("ASTROLABE_LIVES", 150);
  const std::uint64_t first = support::number_from("ASTROLABE_LIVES_SEED", 20'261'122);
  std::uint64_t ticks = 0, powered = 0;
  int silences = 0, with_power = 0, refused = 0;
  std::uint32_t faults = 0;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const support::LifeReport life = support::live(seed);
    ASSERT_EQ(life.violation, "") << "ASTROLABE_LIVES=1 ASTROLABE_LIVES_SEED=" << seed << " repeats it";
    ticks += life.ticks;
    powered += life.powered_ticks;
    silences += life.silences;
    with_power += life.silences_that_began_with_power;
    refused += life.refused_after_halt;
    faults |= life.faults_seen;
  }
  fmt::print(
      "{} lives from seed {}: {:.1f} hours, {:.1f} with power, {} silences, {} of them begun with power, "
      "{} motion requests refused after a halt\n",
      count, first, static_cast<double>(ticks) / 3.6e6, static_cast<double>(powered) / 3.6e6, silences,
      with_power, refused);
  if (count < 150) return;
  // Lives in which nothing happens would show nothing.
  EXPECT_GT(with_power, static_cast<int>(count) / 10);
  EXPECT_GT(refused, static_cast<int>(count));
  for (const Fault fault : {Fault::command_timeout, Fault::link_lost, Fault::under_voltage,
                            Fault::over_voltage, Fault::over_speed, Fault::stall, Fault::encoder,
                            Fault::runaway, Fault::emergency_stop, Fault::stop_timeout})
    EXPECT_NE(faults & bit(fault), 0U) << name(fault) << " never came up";
}

}  // namespace
}  // namespace astro
