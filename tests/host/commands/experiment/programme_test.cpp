#include <gmock/gmock.h>

#include "host/commands/experiment/record_programme.hpp"
#include "host/commands/simulate/programme_options.hpp"

namespace astro::commands {
namespace {

TEST(Programme, IsDrivenHalfEachWayAnOddRunClockwise) {
  std::vector<std::string> titles;
  for (const ProgrammeRun& run : runs_of(simulation::study::Programme{}.with({3, 1, 0, 2})))
    titles.push_back(run.spec.title());
  EXPECT_THAT(titles, testing::ElementsAre("square cw 1", "square ccw 1", "square cw 2", "line 1",
                                           "circle cw 1", "circle ccw 1"));
}

TEST(Programme, IsAskedForWithoutWhatIsUsual) {
  simulation::study::Programme programme = simulation::study::Programme{}.with({0, 3, 2, 0});
  EXPECT_EQ(options_for(programme), "--lines 3 --spins 2");
  programme.turns = 2.5;
  programme.radius_m = 0.5;  // of circles, of which there are none
  programme.speed_mps = 0.2;
  EXPECT_EQ(options_for(programme), "--lines 3 --spins 2 --turns 2.5 --speed 0.2");
}

}  // namespace
}  // namespace astro::commands
