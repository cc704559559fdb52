#include "host/commands/drive/check_wiring.hpp"

#include <gmock/gmock.h>

namespace astro::commands {
namespace {

TEST(Sighting, WordsMeanWhatTheySay) {
  EXPECT_EQ(sighting_from("lb")->wheel, Side::left);
  EXPECT_FALSE(sighting_from("left-backward")->forward);
  EXPECT_EQ(sighting_from("rf")->wheel, Side::right);
  EXPECT_FALSE(sighting_from("none")->wheel);
  EXPECT_FALSE(sighting_from("LF"));
  EXPECT_FALSE(sighting_from(""));
}

}  // namespace
}  // namespace astro::commands
