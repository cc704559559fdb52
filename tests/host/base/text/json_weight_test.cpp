#include "host/base/text/json_weight.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/base/bounded.hpp"

namespace astro {
namespace {

TEST(JsonWeight, IsTooMuchWhereShortValuesWouldTakeManyTimesTheirText) {
  for (const char* value : {"[],", "1,", "{},", "[", "\"\":0,", "\"\","})
    EXPECT_FALSE(json_fits_memory(support::filled(value, 8'000'000))) << value;
}

TEST(JsonWeight, IsTooMuchWhereTextNestsDeeply) {
  EXPECT_FALSE(json_fits_memory(std::string(101, '[')));
  EXPECT_TRUE(json_fits_memory(std::string(100, '[') + std::string(100, ']') + ',' + std::string(100, '[')));
  EXPECT_TRUE(json_fits_memory('"' + std::string(1000, '[') + '"'));
}

TEST(JsonWeight, LetsSmallTextAndLongValuesThrough) {
  EXPECT_TRUE(json_fits_memory(""));
  EXPECT_TRUE(json_fits_memory(support::filled("[],", 1'000'000))) << "64 MB at most";
  EXPECT_TRUE(json_fits_memory(support::filled("   0.12345678901234567,\n", 60'000'000)))
      << "the shards of a study";
  EXPECT_TRUE(json_fits_memory('"' + support::filled("[],", 8'000'000) + '"')) << "one text";
  EXPECT_TRUE(json_fits_memory("\"\\\"" + support::filled("[],", 8'000'000) + '"')) << "with a quote in it";
}

}  // namespace
}  // namespace astro
