#include "host/commands/shared/fault_help.hpp"

#include <gtest/gtest.h>

namespace astro::commands {
namespace {

TEST(FaultHelp, SaysSomethingAboutEveryFault) {
  for (std::size_t i = 1; i < kFaultNames.size(); ++i)
    EXPECT_GT(fault_help(static_cast<Fault>(i)).size(), 20U) << kFaultNames[i];
  EXPECT_EQ(fault_help(static_cast<Fault>(200)), "");
}

}  // namespace
}  // namespace astro::commands
