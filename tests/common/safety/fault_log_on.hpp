#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "common/safety/fault_log.hpp"
#include "hal/sim/flash.hpp"

namespace astro::support {

/// Entry number n of a test: no two alike in any field that could hide a mix-up.
inline FaultCircumstances circumstances(std::uint32_t n) {
  return {.time_us = 0x1'0000'0000U + n,
          .battery_mv = static_cast<std::int32_t>(11'000 + n),
          .left_umps = static_cast<std::int32_t>(n),
          .right_umps = -static_cast<std::int32_t>(n),
          .missed = static_cast<std::uint16_t>(n * 7),
          .fault = static_cast<Fault>(1 + n % 12),
          .mode = static_cast<std::uint8_t>(n % 6)};
}

/// All that is in the log, the newest first, as after a restart.
template <class Flash>
std::vector<LoggedFault> entries(Flash& flash) {
  std::vector<LoggedFault> all;
  FaultLog<Flash>(flash).walk([&](const LoggedFault& entry) {
    all.push_back(entry);
    return true;
  });
  return all;
}

template <class Flash>
bool append(Flash& flash, std::uint32_t n, std::uint32_t start = 1) {
  return FaultLog<Flash>(flash).append(circumstances(n), start);
}

/// On the reference robot's sectors, with two small ones more, on a part that programs pages.
template <class Flash>
class FaultLogOn : public ::testing::Test {
 protected:
  static constexpr std::uint32_t kSlots = FaultLog<Flash>::kSlots;
  Flash flash;
  void TearDown() override { EXPECT_EQ(flash.misuses(), 0); }
};
using LogGeometries = ::testing::Types<sim::SimulatedFlash<2, 4096, 8>, sim::SimulatedFlash<4, 512, 1>,
                                       sim::SimulatedFlash<2, 1024, 256>>;

}  // namespace astro::support
