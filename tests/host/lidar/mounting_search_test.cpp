#include "host/lidar/mounting_search.hpp"

#include <gtest/gtest.h>

#include <ctime>

#include "tests/host/lidar/synthetic_room.hpp"

namespace astro::lidar {
namespace {

TEST(MountingSearch, OfARobotThatStandsTakesNoTimeForEachPairOfScanAndSample) {
  constexpr int kSamples = 500'000, kScans = 20'000;
  ScannedDrive drive;
  for (int i = 0; i < kSamples; ++i) drive.wheels.push_back({1e-3 * i, 0, 0});
  drive.read_scans = [](const ScanHandler& handle) {
    Scan scan;
    for (int i = 0; i < kScans; ++i) {
      scan.time_ns = std::int64_t{25'000'000} * i;
      handle(scan);
    }
  };
  const std::clock_t begin = std::clock();  // of the processor, whatever else it does
  const MountingFound found = find_mounting({&drive, 1}, kLoaded, false);
  EXPECT_EQ(found.driving + found.turning, 0u);
  // A few milliseconds; half a minute if each scan looks at all samples before it.
  EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 2);
}

}  // namespace
}  // namespace astro::lidar
