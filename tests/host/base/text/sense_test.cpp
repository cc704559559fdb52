#include "host/base/text/sense.hpp"

#include <gtest/gtest.h>

namespace astro {
namespace {

TEST(Sense, EachIsFoundByItsName) {
  for (const Sense sense : {Sense::cw, Sense::ccw}) EXPECT_EQ(sense_named(name_of(sense)), sense);
}

TEST(Sense, AnotherTextIsNoDirection) {
  for (const char* text : {"", "none", "CW", "cwx", "clockwise"}) EXPECT_FALSE(sense_named(text)) << text;
}

TEST(Sense, CounterClockwiseIsPositiveAsAnglesAre) {
  EXPECT_EQ(sign_of(Sense::ccw), 1);
  EXPECT_EQ(sign_of(opposite(Sense::ccw)), -1);
}

}  // namespace
}  // namespace astro
