#include "host/experiment/drive/programme_work.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "host/experiment/files/experiment_folder.hpp"
#include "tests/support/base/temporary_folder.hpp"

namespace astro::experiment {
namespace {

Plan squares_of(double side_m) {
  Plan plan;
  plan.side_m = side_m;
  plan.runs = 2;
  plan.extras = false;
  return plan;
}

TEST(ProgrammeWork, KnowsTheFieldOfSquaresBothWaysRound) {
  // So long a wheelbase that wheels which differ hardly turn it; a wheelbase that is 1 % off turns it by 4 %
  // of a turn in each square.
  const DrivenField field = field_of(squares_of(3), 1e9);
  EXPECT_NEAR(field.to_ahead_m, 3, 0.6);
  EXPECT_NEAR(field.from_left_m, -3, 0.6);
  EXPECT_NEAR(field.to_left_m, 3, 0.6);
  EXPECT_GT(field.from_ahead_m, -0.6);
}

TEST(ProgrammeWork, LeavesRoomForSquaresThatTurnAboutTheirStart) {
  // 0.5 % of 12 m on 0.29 m: 12 degrees for each square, the same way whichever way round; four of them.
  const DrivenField field = field_of(squares_of(3), 0.29);
  EXPECT_LT(field.from_ahead_m, -1);
  EXPECT_GT(field.to_ahead_m, 3.5);
  EXPECT_GT(field.to_left_m, 3.5);
}

TEST(ProgrammeWork, CountsWhatIsNotRecordedYet) {
  const test::TemporaryFolder folder;
  const Plan plan = squares_of(3);
  const ProgrammeWork all = work_of(plan, folder.path());
  EXPECT_EQ(all.left, 8) << "two each way, before and after";
  const auto file = file_of(folder.path(), runs_of_phase(plan, 0, 2).front());
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << "recorded";
  const ProgrammeWork rest = work_of(plan, folder.path());
  EXPECT_EQ(rest.left, 7);
  EXPECT_EQ(rest.all, 8);
  EXPECT_NEAR(rest.driving_s, all.driving_s * 7 / 8, 1e-9);
  EXPECT_GT(all.driving_s, 8 * 12 / plan.speed_mps);
}

}  // namespace
}  // namespace astro::experiment
