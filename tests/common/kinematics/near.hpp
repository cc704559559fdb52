#pragma once

#include <gtest/gtest.h>

#include "tests/common/kinematics/exact.hpp"

namespace astro::tests {

/// For ASSERT_PRED_FORMAT3: EXPECT_NEAR compares in double, which is coarser than what is tested here.
inline testing::AssertionResult near(const char* what, const char* expected_text, const char* bound_text,
                                     Real got, Real expected, Real bound) {
  if (std::fabs(got - expected) <= bound) return testing::AssertionSuccess();
  return testing::AssertionFailure() << what << " is " << static_cast<double>(got) << ", " << expected_text
                                     << " is " << static_cast<double>(expected) << ": apart by "
                                     << static_cast<double>(got - expected) << ", bound " << bound_text
                                     << " = " << static_cast<double>(bound);
}

}  // namespace astro::tests
