#include "hal/teensy40/arithmetic/identity.hpp"

#include <gtest/gtest.h>

#include <set>

namespace astro::teensy40 {
namespace {

TEST(Identity, FuseWordsBecomeBytesLowestFirst) {
  const UniqueId id = unique_id({0x0302'0100, 0x0706'0504, 0x0B0A'0908, 0x0F0E'0D0C});
  for (std::size_t i = 0; i < id.size(); ++i) EXPECT_EQ(id[i], i);
}

TEST(Identity, EveryFuseBitTellsRobotsApart) {
  std::set<UniqueId> ids{unique_id({})};
  for (std::size_t bit = 0; bit < 128; ++bit) {
    std::array<std::uint32_t, 4> fuses{};
    fuses[bit / 32] = 1U << bit % 32;
    ids.insert(unique_id(fuses));
  }
  EXPECT_EQ(ids.size(), 129U);
}

}  // namespace
}  // namespace astro::teensy40
