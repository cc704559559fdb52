#include "common/control/slew.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstdlib>

namespace astro {
namespace {

RC_GTEST_PROP(Slew, ArrivesExactlyInTheFewestTicksAndNeverPasses, ()) {
  const auto start = *rc::gen::inRange(-2'000'000, 2'000'000),
             target = *rc::gen::inRange(-2'000'000, 2'000'000);
  const auto step = *rc::gen::inRange(1, 100'000);
  RC_PRE(std::abs(target - start) / step < 10'000);
  Slew slew;
  slew.set(start);
  const int ticks = (std::abs(target - start) + step - 1) / step;
  for (int tick = 0; tick < ticks; ++tick) {
    const int before = slew.value();
    RC_ASSERT(before != target);
    slew.advance(target, step);
    RC_ASSERT(std::abs(slew.change()) <= step);
    RC_ASSERT(slew.value() == before + slew.change());
    RC_ASSERT(std::abs(target - slew.value()) < std::abs(target - before));  // closer, so never beyond
  }
  RC_ASSERT(slew.value() == target);
  slew.advance(target, step);
  RC_ASSERT(slew.value() == target);
  RC_ASSERT(slew.change() == 0);
}

TEST(Slew, CrossesTheWholeRangeWithoutOverflow) {
  Slew slew;
  slew.set(INT32_MIN);
  slew.advance(INT32_MAX, INT32_MAX);
  EXPECT_EQ(slew.value(), -1);
  slew.advance(INT32_MAX, INT32_MAX);
  EXPECT_EQ(slew.value(), INT32_MAX - 1);
  slew.advance(INT32_MAX, INT32_MAX);
  EXPECT_EQ(slew.value(), INT32_MAX);
}

TEST(Slew, SettingForgetsTheLastChange) {
  Slew slew;
  slew.advance(100, 10);
  slew.set(50);
  EXPECT_EQ(slew.value(), 50);
  EXPECT_EQ(slew.change(), 0);
}

}  // namespace
}  // namespace astro
