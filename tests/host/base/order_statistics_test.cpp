#include "host/base/order_statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace astro {
namespace {

TEST(OrderStatistics, AreTheValuesOfTheSortedList) {
  std::mt19937 random(1);
  for (std::size_t count = 1; count <= 20; ++count) {
    std::vector<double> values(count);
    for (double& value : values) value = std::uniform_int_distribution(-5, 5)(random);  // some of them equal
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t rank = 0; rank < count; ++rank) EXPECT_EQ(at_rank(values, rank), sorted[rank]);
    EXPECT_EQ(median_of(values), sorted[count / 2]);
    EXPECT_EQ(lower_median_of(values), sorted[(count - 1) / 2]);
  }
}

/// The error of the median of 10,001 normal magnitudes is 0.6 %; five times as much is allowed.
TEST(OrderStatistics, TellTheDeviationOfNormalErrorsBesideSomeThatAreFarOff) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal(0, 3);
  std::vector<double> errors(10'001);
  for (double& error : errors) error = normal(random);
  for (std::size_t i = 0; i < 50; ++i) errors[i] = 1e6;
  EXPECT_NEAR(deviation_of(errors), 3, 0.09);
}

}  // namespace
}  // namespace astro
