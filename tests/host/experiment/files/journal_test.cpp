#include "host/experiment/files/journal.hpp"

#include <gtest/gtest.h>

#include <array>

#include "tests/host/experiment/files/older_journal.hpp"
#include "tests/support/base/temporary_folder.hpp"

namespace astro::experiment {
namespace {

using Numbers = std::array<double, 5>;

Numbers numbers_of(const calibration::WheelFactors& factors) {
  return {factors.c_r, factors.c_l, factors.b_m, factors.e, factors.kappa0};
}

TEST(Journal, KeepsTheFactorsOfEachPhaseWithTheirCurvatureEffect) {
  const test::TemporaryFolder folder;
  Journal journal;
  journal.plan.truth = "sim";
  journal.loaded = {{"before", {1.001, 0.999, 0.29, 0.02, 0.2}}, {"after", {1, 1, 0.288}}};
  write_journal(folder.path(), journal);
  const Journal read = read_journal(folder.path());
  EXPECT_EQ(numbers_of(read.loaded.at("before")), (Numbers{1.001, 0.999, 0.29, 0.02, 0.2}));
  EXPECT_EQ(numbers_of(read.loaded.at("after")), (Numbers{1, 1, 0.288, 0, calibration::kUsualKappa0}));
}

TEST(Journal, FromBeforeThereWasAnEHasNone) {
  const test::TemporaryFolder folder;
  Journal journal;
  journal.plan.truth = "sim";
  journal.loaded = {{"before", {1.001, 0.999, 0.29, 0.02, 0.2}}};
  write_journal(folder.path(), journal);
  test::make_older_than_e(folder.path());
  const Journal read = read_journal(folder.path());
  EXPECT_EQ(numbers_of(read.loaded.at("before")),
            (Numbers{1.001, 0.999, 0.29, 0, calibration::kUsualKappa0}));
  EXPECT_EQ(read.plan.circles, 1) << "of one turn each way";
  EXPECT_EQ(read.plan.circle_turns, 1);
}

}  // namespace
}  // namespace astro::experiment
